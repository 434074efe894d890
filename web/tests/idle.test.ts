import assert from "node:assert/strict";
import { test } from "node:test";
import { blink } from "../src/shared/idle.ts";

const times = Array.from({ length: 60 * 60 }, (_, frame) => frame / 60);

test("the lids close wholly, about every four seconds, and are open otherwise", () => {
  let closings = 0;
  for (const time of times) if (blink(time) === 1 && blink(time - 1 / 60) < 1) closings++;
  assert.ok(closings >= 13 && closings <= 16, `${closings} blinks a minute`);
  assert.ok(times.filter((time) => blink(time) > 0).length < 0.1 * times.length);
});

test("the same time gives the same lids, and they never jump", () => {
  for (const time of times) {
    assert.equal(blink(time), blink(time));
    assert.ok(Math.abs(blink(time) - blink(time - 1 / 240)) < 0.1);
  }
});

test("there is no blink in the first instant", () => {
  assert.equal(blink(0), 0);
  assert.equal(blink(-0.2), 0);
});
