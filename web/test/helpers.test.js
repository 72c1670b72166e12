// Workers that help: what they are given, and what happens where they fail.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Helpers, threadCount } from "../dist/helpers.js";
import { Played } from "./support/played.js";

const REQUEST = { module: "compiled", normal: { name: "normal.safetensors", bytes: new Uint8Array(1) } };
const WORK = [Uint32Array.of(1), Float32Array.of(2)];

function start(count) {
  const workers = [];
  const startHelper = () => {
    workers.push(new Played());
    return workers.at(-1);
  };
  return { helpers: new Helpers(count, { startHelper }, REQUEST), workers };
}

/** Lets promises that can be kept be kept. */
const settled = () => new Promise((resolve) => setImmediate(resolve));

test("as many threads as there are, four at most, or as are wished for", () => {
  assert.deepEqual(
    [1, 2, 4, 64].map((cores) => threadCount(undefined, cores)),
    [1, 2, 4, 4],
  );
  assert.equal(threadCount(6, 2), 6);
  for (const wrong of [0, -1, 1.5, Number.NaN, "2"]) {
    assert.throws(
      () => threadCount(wrong, 2),
      (error) => error.kind === "input" && error.message.startsWith(`threads: found ${wrong}`),
    );
  }
});

test("helpers get the module, then work, one after the other", async () => {
  const { helpers, workers } = start(2);
  assert.equal(helpers.count, 2);
  const [first, second] = workers;
  assert.deepEqual(first.asked, [{ task: "help", request: REQUEST }]);
  const answers = [helpers.features(1, ...WORK), helpers.features(1, ...WORK)];
  await settled();
  assert.equal(second.asked.length, 1);
  second.say({ event: "done", response: undefined });
  await settled();
  assert.deepEqual(second.asked[1], { task: "features", request: { shapes: WORK[0], values: WORK[1] } });
  assert.equal(second.asked.length, 2);
  second.say({ event: "done", response: "one" });
  await settled();
  second.say({ event: "done", response: "two" });
  assert.deepEqual(await Promise.all(answers), ["one", "two"]);
  helpers.free();
  assert.deepEqual([helpers.count, first.terminated, second.terminated], [0, true, true]);
});

test("who fails is not asked again, and its work comes back undone", async () => {
  const { helpers, workers } = start(3);
  const [unable, broken, silent] = workers;
  unable.say({ event: "failed", kind: "device", message: "no weights" });
  await settled();
  assert.equal(helpers.count, 2);
  assert.ok(unable.terminated);
  broken.say({ event: "done", response: undefined });
  const answer = helpers.features(0, ...WORK);
  await settled();
  broken.say({ event: "crashed", message: "memory", gpu: false });
  assert.equal(await answer, undefined);
  assert.equal(helpers.count, 1);
  silent.onerror({ message: "blocked" });
  await settled();
  assert.equal(helpers.count, 0);
  assert.equal(await helpers.features(0, ...WORK), undefined);
});

test("where no worker can be started, nobody helps", () => {
  const refused = () => {
    throw new Error("no");
  };
  assert.equal(new Helpers(3, { startHelper: refused }, REQUEST).count, 0);
  assert.equal(new Helpers(3, {}, REQUEST).count, 0);
});
