import assert from "node:assert/strict";
import { test } from "node:test";
import { clockTime, milliseconds, niceStep, rulerTime } from "../src/shared/format.ts";

test("times are minutes, seconds and thousandths", () => {
  assert.equal(clockTime(0), "0:00.000");
  assert.equal(clockTime(1.5), "0:01.500");
  assert.equal(clockTime(59.9996), "1:00.000");
  assert.equal(clockTime(125.25), "2:05.250");
  assert.equal(clockTime(-0.2), "−0:00.200");
  assert.equal(clockTime(-0.0001), "0:00.000");
});

test("the ruler writes no more digits than its step needs", () => {
  assert.equal(rulerTime(2, 1), "2 s");
  assert.equal(rulerTime(0.2, 0.1), "0.2 s");
  assert.equal(rulerTime(0.25, 0.05), "0.25 s");
  assert.equal(rulerTime(-0.2, 0.2), "−0.2 s");
  assert.equal(rulerTime(-1e-12, 0.2), "0.0 s");
  assert.equal(rulerTime(90, 10), "1:30");
  assert.equal(rulerTime(90.5, 0.5), "1:30.5");
});

test("steps of the ruler are round, in seconds and in minutes", () => {
  assert.equal(niceStep(0.13), 0.2);
  assert.equal(niceStep(0.3), 0.5);
  assert.equal(niceStep(0.7), 1);
  assert.equal(niceStep(1), 1);
  assert.equal(niceStep(14), 15);
  assert.equal(niceStep(170), 300);
});

test("lengths are whole milliseconds", () => {
  assert.equal(milliseconds(0.0834), "83 ms");
});
