import assert from "node:assert/strict";
import { basename } from "node:path";
import { after, before, test } from "node:test";
import { AVIF_BALLS } from "./support/avif.js";
import { normalDifference, rounded } from "./support/compare.js";
import { commandResults, goldenStack, greyPng, zipOf } from "./support/files.js";
import { Page } from "./support/page.js";
import { tiffPages } from "./support/tiff.js";

/** @typedef {import("./support/files.js").TestFile} TestFile */

const golden = goldenStack();
const photographs = golden.filter(({ name }) => name !== "mask.png");
const text = new TextEncoder();
/** @type {Page} */
let page;

before(async () => {
  page = await Page.open({ webgpu: false });
});
after(() => page.close());

/** Lines of a list on the page. @param {string} list */
const lines = (list) => page.page.locator(`${list} li`).allTextContents();

/** A file of a format that is recognised and not read. @type {TestFile} */
const heic = {
  name: "IMG_0042.heic",
  bytes: new Uint8Array([0, 0, 0, 24, ...text.encode("ftypheic"), 0, 0, 0, 0, ...text.encode("mif1heic")]),
};

/**
 * The command's plan of the same files; it knows where the list lies, the page its name alone.
 * @param {TestFile[]} files @param {string[]} options
 */
function commandPlan(files, ...options) {
  const report = commandResults(files, ...options).get("report.json");
  const { plan } = JSON.parse(new TextDecoder().decode(report), rounded);
  if (plan.order.list) plan.order.list = basename(plan.order.list);
  return plan;
}

/** The page's plan, from the report that it offers. */
async function pagePlan() {
  return JSON.parse((await page.download("report.json")).toString("utf8"), rounded).plan;
}

/** Files, and what must be said of them before and after the run. @type {[string, TestFile[], RegExp[], RegExp[]][]} */
const cases = [
  [
    "photographs of a phone beside PNG files are named",
    [...golden, heic],
    [/left out: IMG_0042\.heic \(HEIC/],
    [/^left out: IMG_0042\.heic \(HEIC/, /^mask: mask\.png/],
  ],
  [
    "maps of another tool are no photographs",
    [...golden, ...["normal.png", "albedo.png"].map((name) => greyPng(name, 92, 92, 128))],
    [/normal\.png \(a map, by the word/],
    [/^left out: albedo\.png \(a map/, /^left out: normal\.png \(a map/],
  ],
  [
    "a list decides about the photographs and their order",
    [
      ...golden,
      { name: "filenames.txt", bytes: text.encode("005.png\r\n003.PNG\r\n001.png\r\n007.png\r\n") },
    ],
    [/not in the list/],
    [/^photographs: 4 \(as filenames\.txt lists them\): 005\.png, 003\.png, 001\.png, 007\.png/],
  ],
  [
    "a wrong extension is noticed",
    photographs.map((file, index) => (index === 0 ? { ...file, name: "001.jpg" } : file)),
    [],
    [/001\.jpg/],
  ],
];

for (const [what, files, before, after] of cases) {
  test(`${what}, on the page as on the command`, async () => {
    await page.upload(files);
    await page.page.waitForSelector("#start:enabled");
    for (const expected of before) {
      await page.page.locator("#stack-notes li", { hasText: expected }).waitFor();
    }
    assert.equal(await page.estimate(), "");
    const said = await lines("#plan");
    for (const expected of after)
      assert.ok(
        said.some((line) => expected.test(line)),
        said.join("\n"),
      );
    assert.deepEqual(await pagePlan(), commandPlan(files));
    page.assertQuiet();
  });
}

test("a zip is a capture like any other", async () => {
  const inside = golden.map((file) => ({ ...file, name: `vase/${file.name}` }));
  const rubbish = { name: "__MACOSX/vase/._001.png", bytes: text.encode("finder") };
  await page.upload([zipOf("capture.zip", [...inside, rubbish])]);
  await page.thumbnails(golden.length);
  assert.match((await page.page.textContent("#stack-words")) ?? "", /out of capture\.zip/);
  assert.equal(await page.estimate(), "");
  const expected = commandResults(golden).get("normals.npy") ?? new Uint8Array();
  const degrees = normalDifference(expected, await page.download("normals.npy"));
  assert.ok(degrees < 0.1, `${degrees} degrees`);
  page.assertQuiet();
});

test("the pages of a TIFF are a capture like any other", async () => {
  /** @type {[number, number][]} */
  const lamps = [
    [-0.5, 0.3],
    [0.5, 0.3],
    [0, -0.5],
    [0, 0.6],
    [0.1, 0.1],
  ];
  const pages = tiffPages("stack.tif", 64, lamps);
  await page.upload([pages]);
  await page.thumbnails(lamps.length);
  assert.match((await page.page.textContent("#stack-words")) ?? "", /out of stack\.tif/);
  assert.equal(await page.estimate(), "");
  const expected = commandResults([pages]).get("normals.npy") ?? new Uint8Array();
  const degrees = normalDifference(expected, await page.download("normals.npy"));
  assert.ok(degrees < 0.1, `normals differ by ${degrees} degrees`);
  page.assertQuiet();
});

test("what is doubtful is shown before the result, and goes with the photographs", async () => {
  await page.upload([...photographs, { name: "rejected.txt", bytes: text.encode("001.png\n") }]);
  assert.equal(await page.estimate(), "");
  const said = await lines("#notices");
  assert.ok(said.length > 0, "the guessed mask or the list is said");
  assert.deepEqual(said, await page.page.locator("#plan li.doubtful").allTextContents());
  await page.page.click("#clear");
  await page.page.waitForSelector("#notices", { state: "hidden" });
});

test("what only the browser decodes is decoded, and said", async () => {
  await page.upload(AVIF_BALLS);
  await page.thumbnails(AVIF_BALLS.length);
  assert.equal(await page.estimate(), "");
  const said = await lines("#notices");
  assert.ok(
    said.some((line) => /^ball_1\.avif, .*ball_4\.avif: AVIF, decoded by this browser/.test(line)),
    said.join("\n"),
  );
  assert.ok(!said.some((line) => /extension|nothing in the photographs says/.test(line)), said.join("\n"));
  const { color } = await pagePlan();
  assert.deepEqual(color, { taken: "sRGB", because: "stated" });
});

test("lights with another handedness: their axes are a setting", async () => {
  const lights = photographs.map((_, index) => {
    const turn = (index * 2 * Math.PI) / photographs.length;
    return [0.5 * Math.cos(turn), 0.5 * Math.sin(turn), 0.8];
  });
  /** @param {number} sign */
  const file = (sign) => ({
    name: sign > 0 ? "ours.lp" : "theirs.lp",
    bytes: text.encode(
      [
        photographs.length,
        ...photographs.map(({ name }, index) => {
          const [x = 0, y = 0, z = 0] = lights[index] ?? [];
          // As programs of a country with decimal commas write it on Windows.
          return `C:\\shots\\${name}\t${[x, sign * y, z].map((value) => value.toFixed(5).replace(".", ",")).join("\t")}`;
        }),
      ].join("\r\n"),
    ),
  });
  await page.upload(golden);
  const tables = [];
  for (const [sign, axes] of /** @type {[number, string][]} */ ([
    [1, "x-right,y-up,z-out"],
    [-1, "x-right,y-down,z-out"],
  ])) {
    await page.choose("lights", file(sign));
    await page.page.selectOption('select[name="light-axes"]', axes);
    assert.equal(await page.estimate(), "");
    const said = await lines("#plan");
    assert.ok(
      said.some((line) => /^lights: (ours|theirs)\.lp, matched by /.test(line)),
      said.join("\n"),
    );
    tables.push(await page.page.locator("#lights tr").allTextContents());
  }
  assert.deepEqual(tables[0], tables[1]);
  await page.page.click('label:has(input[name="lights"][value="auto"])');
  await page.page.waitForSelector("#light-axes", { state: "hidden" });
});
