import assert from "node:assert/strict";
import { test } from "node:test";
import { curves, endOf, peaks, sample } from "../src/shared/curves.ts";

const two = curves(["open", "W"], 10, -0.1, [
  [0, 1],
  [0.5, 0],
  [1, 0.25],
]);

test("a frame's instant gives the frame", () => {
  assert.deepEqual([...sample(two, 0)], [0.5, 0]);
});

test("between two frames the values are on the line between them", () => {
  const [open, w] = sample(two, 0.075);
  assert.ok(Math.abs(open - 0.875) < 1e-6);
  assert.ok(Math.abs(w - 0.1875) < 1e-6);
});

test("before the first and after the last frame the values are held", () => {
  assert.deepEqual([...sample(two, -5)], [0, 1]);
  assert.deepEqual([...sample(two, 5)], [1, 0.25]);
});

test("no frames give zero, and no end later than the start", () => {
  const none = curves(["open"], 60, 0.5, []);
  assert.deepEqual([...sample(none, 1)], [0]);
  assert.equal(endOf(none), 0.5);
  assert.equal(endOf(curves([], 60, 0, [[], []])), 0);
});

test("the peak of a curve is its largest value", () => {
  assert.deepEqual([...peaks(two)], [1, 1]);
});
