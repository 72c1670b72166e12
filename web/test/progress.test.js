import assert from "node:assert/strict";
import { test } from "node:test";
import { Aggregate } from "../dist/progress.js";
import { STAGES } from "../dist/types.js";

test("one progress runs from 0 to 1 through all stages", () => {
  const aggregate = new Aggregate();
  let last = 0;
  for (const stage of STAGES) {
    for (const fraction of [0, 0.5, 1]) {
      const progress = aggregate.at(stage, fraction);
      assert.equal(progress.stage, stage);
      assert.ok(progress.fraction >= last);
      last = progress.fraction;
    }
  }
  assert.ok(Math.abs(last - 1) < 1e-9);
});

test("stages that are left out do not set it back", () => {
  const aggregate = new Aggregate();
  assert.ok(aggregate.at("normals", 1).fraction > 0.5);
  assert.ok(aggregate.at("lights", 0).fraction > 0.5);
});
