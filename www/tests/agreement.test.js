import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { STAGES } from "normalight";
import { lightDifference, normalDifference, rounded } from "./support/compare.js";
import { commandResults, goldenStack, sampleFolder, sampleList } from "./support/files.js";
import { Page } from "./support/page.js";

/** Largest mean difference from the native command, in degrees. */
const TOLERANCE = 0.1;

const golden = goldenStack();
/** @type {Page} */
let page;

before(async () => {
  page = await Page.open({ webgpu: true });
});
after(() => page.close());

// Averages take their time on a GPU that the processor imitates: there one view is compared.
for (const { device, quality } of /** @type {const} */ ([
  { device: "cpu", quality: "default" },
  { device: "gpu", quality: "fast" },
])) {
  test(`the page on the ${device} agrees with the command`, async () => {
    await on(device);
    await page.quality(quality);
    await page.upload(golden);
    await page.thumbnails(golden.length);
    assert.equal(await page.page.textContent("#stack-words"), "12 photographs · mask mask.png");
    assert.equal(await page.estimate(), "");
    await assertAgreement(device, commandResults(golden, "--quality", quality));
  });
}

const samples = sampleList();

for (const [index, sample] of samples.entries()) {
  test(`the sample ${sample.name} on the cpu agrees with the command`, async () => {
    await on("cpu");
    // Averages are compared on the golden stack, which takes less time.
    await page.quality("fast");
    const images = index === 0 ? "12" : "all";
    await page.images(images);
    await page.sample(sample);
    const words = `${sample.photographs.length} photographs · mask ${sample.mask}`;
    assert.equal(await page.page.textContent("#stack-words"), words);
    assert.equal(await page.estimate(), "");
    // The folder as it is: the command leaves aside what the page does not fetch, such as the true normals.
    const settings = ["--color", sample.color, "--quality", "fast"];
    if (images !== "all") settings.push("--images", images);
    await assertAgreement("cpu", commandResults(sampleFolder(sample.name), ...settings));
  });
}

test("pictures of a sample's size on the gpu agree with the command", async () => {
  const [sample] = samples;
  assert.ok(sample);
  // Few: here a processor imitates the GPU.
  const names = [sample.mask, ...sample.photographs.slice(0, 3)];
  const files = sampleFolder(sample.name).filter(({ name }) => names.includes(name));
  await on("gpu");
  await page.quality("fast");
  await page.images("all");
  await page.upload(files);
  await page.page.click(`label:has(input[name="color"][value="${sample.color}"])`);
  await page.thumbnails(files.length);
  assert.equal(await page.estimate(), "");
  await assertAgreement("gpu", commandResults(files, "--color", sample.color, "--quality", "fast"));
});

/** @param {"cpu" | "gpu"} device */
async function on(device) {
  assert.equal(await page.device(device), `Ready on the ${device.toUpperCase()}`);
}

/**
 * A report without what differs between devices: which one it was, the time, and last digits.
 * @param {any} report
 */
function comparable(report) {
  const { device, seconds, settings, expected_errors, ...rest } = report;
  const { device: asked, ...others } = settings;
  assert.ok(device && asked && seconds.length > 0);
  for (const { stage } of seconds) assert.ok(stage === "start" || STAGES.includes(stage), stage);
  const stages = seconds.map((/** @type {{ stage: string }} */ { stage }) => stage);
  // Before it reads, the command starts up; the page has done so long ago.
  return {
    ...rest,
    errors: Object.values(expected_errors).map((degrees) => degrees && Number(degrees).toFixed(1)),
    settings: others,
    stages: stages.filter((/** @type {string} */ stage) => stage !== "start"),
  };
}

/**
 * The page's result is the command's.
 * @param {"cpu" | "gpu"} device @param {Map<string, Uint8Array>} results
 */
async function assertAgreement(device, results) {
  /** @param {string} name */
  const result = (name) => {
    const bytes = results.get(name);
    assert.ok(bytes, `the command made no ${name}`);
    return bytes;
  };
  const lights = lightDifference(result("lights.csv"), await page.download("lights.csv"));
  const normals = normalDifference(result("normals.npy"), await page.download("normals.npy"));
  const report = JSON.parse(String(await page.download("report.json")), rounded);
  const seconds = report.seconds.map(
    (/** @type {{ stage: string, seconds: number }} */ stage) => `${stage.stage} ${stage.seconds.toFixed(2)}`,
  );
  console.log(
    `${report.device}: normals ${normals.toExponential(1)}°, lights ${lights.degrees.toExponential(1)}°`,
  );
  console.log(`${report.device}: seconds: ${seconds.join(", ")}`);
  assert.ok(normals < TOLERANCE, `normals differ by ${normals} degrees`);
  assert.ok(lights.degrees < TOLERANCE, `lights differ by ${lights.degrees} degrees`);
  assert.ok(lights.intensity < 0.01, `intensities differ by ${lights.intensity}`);

  assert.match(report.device, device === "gpu" ? /^GPU \(WebGPU, .+\)$/ : /^CPU/);
  const native = JSON.parse(String(result("report.json")), rounded);
  assert.equal(report.settings.device, device);
  assert.deepEqual(comparable(report), comparable(native));
  page.assertQuiet();
}
