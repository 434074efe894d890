import assert from "node:assert/strict";
import { test } from "node:test";
import { layOut } from "../src/shared/rows.ts";
import { Scale } from "../src/shared/scale.ts";
import { shareAt, timeOf } from "../src/studio/curves/laid.ts";
import { edgeAt, lanesOf, movedEdge, roomOf } from "../src/studio/line/rows.ts";

const phones = [
  { label: "l", start: 0.1, end: 0.2 },
  { label: "ow", start: 0.2, end: 0.5 },
  { label: "p", start: 0.6, end: 0.7 },
];

function scaled(): Scale {
  const scale = new Scale({ start: 0, end: 1 });
  scale.width = 1000;
  return scale;
}

test("an edge is taken hold of near it, and nowhere else", () => {
  assert.equal(edgeAt(phones, scaled(), 203), 0);
  assert.equal(edgeAt(phones, scaled(), 98), -1);
  assert.equal(edgeAt(phones, scaled(), 250), null);
  assert.equal(edgeAt([], scaled(), 0), null);
});

test("an edge stays between its neighbours, and no phone vanishes", () => {
  assert.deepEqual(roomOf(phones, 0), [0.11, 0.49]);
  assert.deepEqual(roomOf(phones, -1), [-Infinity, 0.19]);
  assert.equal(roomOf(phones, 2)[1], Infinity);
});

test("a moved edge takes both its phones along, and the word that ends there", () => {
  const moved = movedEdge(phones, 0.2, 0.25);
  assert.deepEqual(
    moved.map(({ start, end }) => [start, end]),
    [
      [0.1, 0.25],
      [0.25, 0.5],
      [0.6, 0.7],
    ],
  );
  assert.equal(movedEdge([{ label: "low", start: 0.1, end: 0.5 }], 0.5, 0.55)[0].end, 0.55);
});

test("curves apart have lanes one under the other, the chosen one's the tallest", () => {
  const rows = layOut(260, { overview: false, wave: true });
  const curves = rows[rows.length - 1];
  const lanes = lanesOf(rows, [0, 2, 3, 5, 7], true, 3);
  assert.deepEqual(
    lanes.map(({ control }) => control),
    [0, 2, 3, 5, 7],
  );
  let below = curves.top;
  for (const { row } of lanes) {
    assert.ok(row.top >= below);
    below = row.top + row.height;
  }
  assert.ok(below <= curves.top + curves.height);
  const tallest = lanes.reduce((a, b) => (b.row.height > a.row.height ? b : a));
  assert.equal(tallest.control, 3);
  assert.ok(tallest.row.height >= 50);
});

test("curves together share one row", () => {
  const rows = layOut(260, { overview: false, wave: true });
  const lanes = lanesOf(rows, [0, 1], false, 0);
  assert.deepEqual(lanes[0].row, lanes[1].row);
});

test("what is edited and what is seen in the line are each other's inverse", () => {
  const places = [
    { first: 0.1, boundary: 0.2, last: 0.5, mark: 0.4 },
    { first: 1.1, boundary: 1.3, last: 1.4, mark: 0.4 },
  ];
  assert.equal(shareAt(places, 0.2), 0.4);
  assert.equal(shareAt(places, 0.8), null);
  for (const share of [0, 0.25, 0.4, 0.9])
    for (const near of [0, 1.2]) {
      const time = timeOf(places, share, near) as number;
      assert.ok(Math.abs((shareAt(places, time) as number) - share) < 1e-9);
      assert.equal(time > 1, near > 1);
    }
  assert.equal(timeOf([], 0.5, 0), null);
});
