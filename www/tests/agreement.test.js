import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { lightDifference, normalDifference } from "./support/compare.js";
import { goldenStack } from "./support/files.js";
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

for (const device of /** @type {const} */ (["cpu", "gpu"])) {
  test(`the page on the ${device} agrees with the command`, async () => {
    assert.equal(await page.device(device), `Ready on the ${device.toUpperCase()}`);
    await page.upload(golden.files);
    await page.thumbnails(golden.files.length);
    assert.equal(await page.page.textContent("#stack-words"), "12 photographs · mask mask.png");
    assert.equal(await page.estimate(), "");

    const lights = lightDifference(result("lights.csv"), await page.download("lights.csv"));
    const normals = normalDifference(result("normals.npy"), await page.download("normals.npy"));
    const report = JSON.parse(String(await page.download("report.json")));
    const seconds = report.seconds.map(
      (/** @type {{ stage: string, seconds: number }} */ stage) =>
        `${stage.stage} ${stage.seconds.toFixed(2)}`,
    );
    console.log(
      `${report.device}: normals ${normals.toExponential(1)}°, lights ${lights.degrees.toExponential(1)}°`,
    );
    console.log(`${report.device}: seconds: ${seconds.join(", ")}`);
    assert.ok(normals < TOLERANCE, `normals differ by ${normals} degrees`);
    assert.ok(lights.degrees < TOLERANCE, `lights differ by ${lights.degrees} degrees`);
    assert.ok(lights.intensity < 0.01, `intensities differ by ${lights.intensity}`);

    assert.match(report.device, device === "gpu" ? /^GPU \(WebGPU, .+\)$/ : /^CPU/);
    const native = JSON.parse(String(result("report.json")));
    assert.deepEqual(report.weights, native.weights);
    assert.deepEqual(report.inputs, native.inputs);
    assert.equal(report.mask, native.mask);
    page.assertQuiet();
  });
}

/** A file that the native command made. @param {string} name */
function result(name) {
  const bytes = golden.results.get(name);
  assert.ok(bytes, `the command made no ${name}`);
  return bytes;
}
