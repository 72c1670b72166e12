import assert from "node:assert/strict";
import { afterEach, test } from "node:test";
import { Normalight } from "../dist/normalight.js";

/** Workers that were started, in order. @type {PlayedWorker[]} */
let started = [];
/** What workers answer, by task. */
let answers = {};

class PlayedWorker {
  asked = [];
  terminated = false;
  onmessage = null;
  onerror = null;
  constructor() {
    started.push(this);
  }
  postMessage(message) {
    this.asked.push(message);
    const answer = answers[message.task]?.(message.request, this);
    if (answer) queueMicrotask(() => this.onmessage?.({ data: answer }));
  }
  terminate() {
    this.terminated = true;
  }
}

globalThis.Worker = PlayedWorker;
afterEach(() => {
  started = [];
  answers = {};
});

const done = (answer) => ({ event: "done", response: answer });
const crashed = { event: "crashed", message: "unreachable", gpu: false };
const file = { name: "a.png", bytes: new Uint8Array() };
const deviceOf = ({ device }) => done({ kind: device === "cpu" ? "cpu" : "gpu", name: device });

test("calls are done one after the other", async () => {
  answers = { create: deviceOf, thumbnail: () => done("small"), plan: () => undefined };
  const normalight = await Normalight.create({ device: "cpu" });
  const plan = normalight.plan([]);
  const thumbnail = normalight.thumbnail(file);
  await new Promise((resolve) => setTimeout(resolve, 5));
  const tasks = () => started[0].asked.map(({ task }) => task);
  assert.deepEqual(tasks(), ["create", "plan"]);
  started[0].onmessage({ data: { event: "failed", kind: "input", message: "bad list" } });
  await assert.rejects(plan, { kind: "input" });
  assert.equal(await thumbnail, "small");
  assert.deepEqual(tasks(), ["create", "plan", "thumbnail"]);
});

test("after a crash the next call gets a new worker", async () => {
  answers = { create: deviceOf, plan: () => crashed, thumbnail: () => done("small") };
  const normalight = await Normalight.create({ device: "gpu" });
  await assert.rejects(normalight.plan([]), { kind: "crashed" });
  assert.equal(await normalight.thumbnail(file), "small");
  assert.equal(started.length, 2);
  assert.equal(normalight.device.kind, "gpu");
});

const isProcessor = ({ kind, notice }) => {
  assert.equal(kind, "cpu");
  assert.match(notice, /^The GPU failed \(unreachable\), so the processor computes\.$/);
};

test("a GPU that breaks in the background gives way to the processor at the next call", async () => {
  answers = { create: deviceOf, thumbnail: () => done("small") };
  const heard = [];
  const normalight = await Normalight.create({ device: "gpu", onDevice: (device) => heard.push(device) });
  started[0].onmessage({ data: { ...crashed, gpu: true } });
  assert.equal(await normalight.thumbnail(file), "small");
  assert.equal(started.length, 2);
  isProcessor(normalight.device);
  assert.deepEqual(heard, [normalight.device]);
});

test("an estimate that breaks the GPU is done by the processor", async () => {
  let estimates = 0;
  answers = {
    create: deviceOf,
    estimate: () => (estimates++ === 0 ? { ...crashed, gpu: true } : done("estimate")),
  };
  const normalight = await Normalight.create({ device: "gpu" });
  assert.equal(await normalight.estimate([]), "estimate");
  isProcessor(normalight.device);
});

test("a worker may say that another device computes", async () => {
  answers = { create: deviceOf };
  const heard = [];
  const normalight = await Normalight.create({ device: "gpu", onDevice: (device) => heard.push(device) });
  const device = { kind: "cpu", name: "CPU", notice: "WebGPU does not start." };
  started[0].onmessage({ data: { event: "device", device } });
  assert.deepEqual([normalight.device, ...heard], [device, device]);
});

test("a closed estimator refuses, and ends what is under way", async () => {
  answers = { create: deviceOf };
  const normalight = await Normalight.create({ device: "cpu" });
  const plan = normalight.plan([]);
  await new Promise((resolve) => setTimeout(resolve, 5));
  normalight.close();
  await assert.rejects(plan, { kind: "closed" });
  await assert.rejects(normalight.thumbnail(file), { kind: "closed" });
  assert.equal(started[0].terminated, true);
});

test("what is left out of the options has its default", async () => {
  answers = { create: deviceOf, estimate: ({ settings }) => done(settings) };
  const normalight = await Normalight.create({ device: "cpu" });
  assert.deepEqual(await normalight.estimate([]), {
    color: "auto",
    mask: "auto",
    lightAxes: "x-right,y-up,z-out",
    align: false,
    ambient: "none",
    images: undefined,
    normalFormat: "opengl",
    refit: true,
    quality: "default",
  });
  const { refit, quality } = await normalight.estimate([], { refit: false, quality: "best" });
  assert.deepEqual([refit, quality], [false, "best"]);
});

test("a call that was cancelled before its turn is never begun", async () => {
  answers = { create: deviceOf };
  const normalight = await Normalight.create({ device: "cpu" });
  const estimate = normalight.estimate([], { signal: AbortSignal.abort() });
  await assert.rejects(estimate, { name: "AbortError" });
  assert.equal(started[0].asked.length, 1);
});
