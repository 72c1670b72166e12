import assert from "node:assert/strict";
import { test } from "node:test";
import { Connection } from "../dist/connection.js";
import { NormalightError } from "../dist/errors.js";
import { Played } from "./support/played.js";

function connect() {
  const worker = new Played();
  return { worker, connection: new Connection(worker) };
}

test("responses and events come back", async () => {
  const { worker, connection } = connect();
  const heard = [];
  const answer = connection.run("plan", { files: [] }, { onEvent: (event) => heard.push(event.fraction) });
  assert.deepEqual(worker.asked, [{ task: "plan", request: { files: [] } }]);
  worker.say({ event: "progress", stage: "lights", fraction: 0.5 });
  worker.say({ event: "done", response: { images: [1] } });
  assert.deepEqual(await answer, { images: [1] });
  assert.deepEqual(heard, [0.5]);
});

test("failures are typed", async () => {
  const { worker, connection } = connect();
  const answer = connection.run("plan", { files: [] });
  worker.say({ event: "failed", kind: "input", message: "a.png: broken" });
  await assert.rejects(answer, new NormalightError("input", "a.png: broken"));
  assert.equal(connection.terminated, false);
});

test("a cancelled task rejects with the signal's reason", async () => {
  const { worker, connection } = connect();
  const controller = new AbortController();
  const answer = connection.run("estimate", {}, { signal: controller.signal });
  controller.abort(new Error("enough"));
  assert.deepEqual(worker.asked.at(-1), { task: "cancel" });
  worker.say({ event: "failed", kind: "cancelled", message: "cancelled" });
  await assert.rejects(answer, /enough/);
  assert.equal(connection.terminated, false);
});

test("a task that does not hear the cancel loses its worker", async (t) => {
  t.mock.timers.enable({ apis: ["setTimeout"] });
  const { worker, connection } = connect();
  const controller = new AbortController();
  const answer = connection.run("estimate", {}, { signal: controller.signal });
  controller.abort();
  t.mock.timers.tick(3000);
  await assert.rejects(answer, { name: "AbortError" });
  assert.equal(worker.terminated, true);
  assert.equal(connection.terminated, true);
});

test("after a crash every task fails with its words", async () => {
  const { worker, connection } = connect();
  const answer = connection.run("plan", { files: [] });
  worker.say({ event: "crashed", message: "index out of bounds" });
  await assert.rejects(answer, { kind: "crashed", message: /index out of bounds/ });
  await assert.rejects(connection.run("plan", { files: [] }), { kind: "crashed" });
  assert.equal(worker.terminated, true);
});
