import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drop } from "./support/drop.js";
import { greyPng, sampleFolder, sampleList } from "./support/files.js";
import { Page } from "./support/page.js";

/** @typedef {import("./support/files.js").TestFile} TestFile */

const [statue] = sampleList();
assert.ok(statue);
const photographs = sampleFolder(statue.name).filter(({ name }) => /^\d+\.png$/.test(name));
const text = new TextEncoder();
/** @type {Page} */
let page;

before(async () => {
  page = await Page.open({ webgpu: false });
});
after(() => page.close());

/** As many small photographs under lamps from three sides. @param {number} count */
const small = (count) =>
  Array.from({ length: count }, (_, index) => {
    const lit = /** @type {const} */ (["x", "y", "both"])[index % 3];
    return greyPng(`${String(index + 1).padStart(3, "0")}.png`, 32, 32, 200, lit);
  });

/** Files in a folder. @param {string} folder @param {TestFile[]} files */
const inFolder = (folder, files) => files.map(({ name, bytes }) => ({ name: `${folder}/${name}`, bytes }));

/** @param {RegExp} words */
async function saysOfFolder(words) {
  const line = page.page.locator("#folder-words", { hasText: words });
  await line.waitFor();
}

test("mask and lights of one stack do not stay with the next", async () => {
  const { page: tab } = page;
  await page.upload(small(3));
  await page.choose("mask", greyPng("chosen.png", 32, 32, 255));
  await page.choose("lights", { name: "chosen.txt", bytes: text.encode("0 0 1\n0 1 1\n1 0 1\n") });
  await page.upload(small(4));
  for (const setting of ["mask", "lights"]) {
    assert.ok(await tab.isChecked(`input[name="${setting}"][value="auto"]`), setting);
    assert.equal(await tab.textContent(`#${setting}-name`), "File…");
  }
  assert.equal(await tab.isVisible("#light-axes"), false);

  await page.choose("mask", greyPng("chosen.png", 32, 32, 255));
  await tab.setInputFiles("#more", [
    { name: "5.png", mimeType: "", buffer: Buffer.from(small(1)[0]?.bytes ?? []) },
  ]);
  assert.ok(await tab.isChecked('input[name="mask"][value="file"]'), "added photographs keep the mask");
});

test("a mask that is chosen before the photographs stays", async () => {
  const { page: tab } = page;
  await tab.click("#clear");
  assert.ok(await tab.isChecked('input[name="mask"][value="auto"]'), "cleared with the photographs");
  await page.choose("mask", greyPng("chosen.png", 32, 32, 255));
  await page.upload(small(3));
  assert.ok(await tab.isChecked('input[name="mask"][value="file"]'));
});

test("an empty folder says so and takes nothing away", async () => {
  await page.upload(small(3));
  await page.thumbnails(3);
  await drop(page.page, [{ name: "nothing/", bytes: new Uint8Array() }]);
  await saysOfFolder(/^The folder nothing is empty\. Nothing was taken\.$/);
  await drop(page.page, inFolder("notes", [{ name: "a.txt", bytes: text.encode("hello") }]));
  await saysOfFolder(/^The folder notes holds no photographs, only one other file/);
  assert.equal(await page.page.locator("#thumbnails li").count(), 3);
});

test("folders in a folder are searched", async () => {
  await drop(page.page, inFolder("capture/raw/photos", small(4)));
  await saysOfFolder(/^The photographs lie in capture\/raw\/photos\.$/);
  await page.thumbnails(4);
  await page.upload(small(3));
  await page.page.waitForSelector("#folder-words", { state: "hidden" });
});

test("of several folders with photographs one is taken, the others are offered", async () => {
  await drop(page.page, [...inFolder("all/bowl", small(5)), ...inFolder("all/vase", small(6))]);
  await saysOfFolder(/^2 folders with photographs lie in the folder all\. Taken: all\/bowl\.$/);
  await page.thumbnails(5);
  await page.page.click('#folder-others button:has-text("all/vase")');
  await page.thumbnails(6);
  assert.equal(
    await page.page.getAttribute('#folder-others button:has-text("vase")', "aria-pressed"),
    "true",
  );
});

test("a folder with one photograph in each of its folders is one stack", async () => {
  const files = small(4).map((file, index) => ({ ...file, name: `dome/lamp${index}/shot.png` }));
  await drop(page.page, files);
  await saysOfFolder(/^The photographs lie in 4 folders\.$/);
  await page.thumbnails(4);
});

test("pictures are pasted, and get names of their own", async () => {
  const { page: tab } = page;
  await page.upload(small(3));
  await tab.click("#clear");
  for (const { bytes } of small(3)) {
    await tab.evaluate((base64) => {
      const data = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const clipboardData = new DataTransfer();
      clipboardData.items.add(new File([data], "image.png", { type: "image/png" }));
      document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
    }, Buffer.from(bytes).toString("base64"));
  }
  await tab.waitForSelector("#thumbnails [data-state] .name:text('image 3.png')");
  assert.deepEqual(await tab.locator("#thumbnails .name").allTextContents(), [
    "image.png",
    "image 2.png",
    "image 3.png",
  ]);
  assert.ok(await tab.isEnabled("#start"));
});

test("what a run finds doubtful about a file is shown on its thumbnail", async () => {
  const { page: tab } = page;
  const [first, ...others] = small(3);
  assert.ok(first);
  await page.quality("fast");
  await page.upload([{ name: "001.jpg", bytes: first.bytes }, ...others]);
  await tab.waitForSelector("#thumbnails [data-state] .name:text('001.jpg')");
  await page.estimate();
  const flag = tab.locator("#thumbnails li:has(.name:text('001.jpg')) .flag");
  assert.match((await flag.getAttribute("aria-label", { timeout: 10_000 })) ?? "", /^in truth PNG/);
});

test("two photographs are too few, and the page says so before anything starts", async () => {
  const { page: tab } = page;
  await tab.click("#clear");
  assert.equal(await tab.textContent("#start-why"), "Choose three photographs or more.");
  await page.upload(small(2));
  await tab.waitForSelector('#start-why:text("Two photographs are not enough: three are needed.")');
  assert.ok(await tab.isDisabled("#start"));
  await page.upload(small(3));
  await tab.waitForSelector("#start-why", { state: "hidden" });
  assert.ok(await tab.isEnabled("#start"));
});

test("after Remove the focus is on the next thumbnail", async () => {
  const { page: tab } = page;
  const focused = () => tab.evaluate(() => document.activeElement?.getAttribute("aria-label"));
  await page.upload(small(5));
  await page.thumbnails(5);
  await tab.focus('[aria-label="Remove 002.png"]');
  await tab.keyboard.press("Enter");
  assert.equal(await focused(), "Remove 003.png");
  await page.thumbnails(4);
  await tab.waitForSelector('#stack-words:text("4 photographs")');
  assert.equal(await focused(), "Remove 003.png");
  await tab.keyboard.press("ArrowRight");
  await tab.keyboard.press("ArrowRight");
  await tab.keyboard.press("Delete");
  assert.equal(await focused(), "Remove 004.png");
});

test("ninety-six photographs are one stop of the tab key", async () => {
  const { page: tab } = page;
  await page.upload(small(96));
  await page.thumbnails(96);
  await tab.focus("#pick-files");
  let stops = 0;
  while ((await tab.evaluate(() => document.activeElement?.id)) !== "start") {
    await tab.keyboard.press("Tab");
    stops += 1;
    assert.ok(stops < 20, "Start is not reached");
  }
  assert.ok(stops <= 10, `${stops} stops`);
  await tab.focus('[aria-label="Remove 001.png"]');
  await tab.keyboard.press("End");
  assert.equal(
    await tab.evaluate(() => document.activeElement?.getAttribute("aria-label")),
    "Remove 096.png",
  );
});

test("in forced colours the chosen setting can be told from the others", async () => {
  const { page: tab } = page;
  await tab.emulateMedia({ forcedColors: "active" });
  const colours = await tab.evaluate(() =>
    [":checked", ":not(:checked)"].map((state) => {
      const spans = [...document.querySelectorAll(`input[name="quality"]${state} + span`)];
      return spans.map((span) => {
        const { backgroundColor, color } = getComputedStyle(span);
        return `${backgroundColor} ${color}`;
      });
    }),
  );
  await tab.emulateMedia({ forcedColors: "none" });
  const [chosen, others] = colours;
  assert.deepEqual([chosen?.length, others?.length], [1, 2]);
  assert.ok(!others?.includes(chosen?.[0] ?? ""), String(colours));
  assert.equal(others?.[0], others?.[1]);
});

test("at 360 pixels no words of ours are cut off", async () => {
  const { page: tab } = page;
  await tab.setViewportSize({ width: 360, height: 800 });
  const cut = await tab.evaluate(() =>
    [...document.querySelectorAll("#bench :is(span, button, p, label, h2, h3, b)")]
      .filter((element) => !element.closest(".thumbnails") && !element.matches(".samples *"))
      .filter(({ scrollWidth, clientWidth }) => clientWidth > 0 && scrollWidth > clientWidth + 1)
      .map(({ textContent }) => textContent),
  );
  const sideways = await tab.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  await tab.setViewportSize({ width: 1280, height: 900 });
  assert.deepEqual(cut, []);
  assert.equal(sideways, 0);
});

test("a run says how long it takes, ignores a drop in words, and is not lost unasked", async () => {
  const { page: tab } = page;
  // Long enough for a drop, a reload and an answer.
  await page.quality("default");
  await page.upload(photographs);
  await page.thumbnails(photographs.length);
  await tab.click("#start");
  await tab.waitForSelector("#cancel:visible");
  await drop(tab, small(3));
  await tab.waitForSelector('#status:text("what was dropped is ignored")');
  const asked = new Promise((resolve) =>
    tab.once("dialog", (dialog) => resolve(dialog.dismiss().then(() => dialog.type()))),
  );
  await tab.evaluate(() => location.reload());
  assert.equal(await asked, "beforeunload");
  await tab.waitForSelector("#progress-left:text-matches('left$')");
  await tab.waitForSelector("#start:visible");
  assert.match((await tab.textContent("#status")) ?? "", /^Done in/);
  assert.match((await tab.textContent("#facts")) ?? "", /16 of 192/);
});

test("landmarks of one kind have names of their own", async () => {
  const twice = await page.page.evaluate(() => {
    const name = (/** @type {Element} */ element) =>
      element.getAttribute("aria-label") ??
      document.getElementById(element.getAttribute("aria-labelledby") ?? "")?.textContent;
    const landmarks = [...document.querySelectorAll("section, form, nav, aside, [role=region]")]
      .filter((element) => name(element))
      .map(
        (element) =>
          `${element.matches("section, [role=region]") ? "region" : element.localName} ${name(element)}`,
      );
    return landmarks.filter((landmark, index) => landmarks.indexOf(landmark) !== index);
  });
  assert.deepEqual(twice, []);
  page.assertQuiet();
});
