import assert from "node:assert/strict";
import { test } from "node:test";
import { Aggregate } from "../dist/progress.js";
import { STAGES } from "../dist/types.js";

test("one progress runs from 0 to 1 through all stages", () => {
  for (const quality of /** @type {const} */ (["fast", "default", "best"])) {
    const aggregate = new Aggregate(quality, true);
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
  }
});

test("the normals that are averaged take the larger share", () => {
  /** @param {"fast" | "default"} quality @param {boolean} refit @param {import("../dist/types.js").Stage} stage */
  const share = (quality, refit, stage) => {
    const aggregate = new Aggregate(quality, refit);
    return aggregate.at(stage, 1).fraction - new Aggregate(quality, refit).at(stage, 0).fraction;
  };
  assert.ok(share("default", true, "final normals") > 1.2 * share("fast", true, "final normals"));
  assert.ok(share("default", true, "normals") < share("fast", true, "normals"));
  assert.ok(share("default", false, "normals") > 1.2 * share("fast", false, "normals"));
});

test("stages that are left out do not set it back", () => {
  const aggregate = new Aggregate("fast", false);
  assert.ok(aggregate.at("normals", 1).fraction > 0.5);
  assert.ok(aggregate.at("lights", 0).fraction > 0.5);
});
