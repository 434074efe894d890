import assert from "node:assert/strict";
import { test } from "node:test";
import * as keys from "../src/studio/curves/keys.ts";
import { frameOf, stretch, type Frame } from "../src/studio/curves/handles.ts";
import type { Curves, Domain, Key } from "../src/studio/curves/keys.ts";

const PAIR: Domain = { first: 0, last: 1, rests: true };
const PHONE: Domain = { first: -1, last: 2, rests: false };

const FV: Key[] = [
  [0, 0],
  [0.15, 1],
  [0.28, 1],
  [0.62, 0],
];
const OPEN: Key[] = [
  [0, 0],
  [0.71, 0.46],
  [1, 0],
];
const both = (): Curves => ({ FV, open: OPEN });
const chosen = (picked: Record<string, number[]>) =>
  new Map(Object.entries(picked).map(([name, list]) => [name, new Set(list)]));

/** What the bigram set wants of every curve, whatever was done to it. */
function assertDrawable(list: Key[], domain = PAIR): void {
  assert.ok(list.length >= 2);
  list.forEach(([time, value], index) => {
    assert.ok(time >= domain.first && time <= domain.last && value >= 0 && value <= 1);
    if (index) assert.ok(time > list[index - 1][0], JSON.stringify(list));
  });
  if (domain.rests) assert.deepEqual([list[0][1], list[list.length - 1][1]], [0, 0]);
}

test("keys of several poses move together, and no further than the first that meets a neighbour", () => {
  const moved = keys.move(both(), chosen({ FV: [1, 2], open: [1] }), PAIR, 0.9, -0.2);
  // open may go up to its end at 1; it is 0.29 away, less the gap.
  assert.deepEqual(moved["open"][1], [0.999, 0.26]);
  assert.deepEqual(moved["FV"].slice(1, 3), [
    [0.439, 0.8],
    [0.569, 0.8],
  ]);
  assert.deepEqual(moved["FV"][3], [0.62, 0]);
});

test("the ends of a curve that rests go sideways and never up; those of a phone go anywhere", () => {
  const up = keys.move(both(), chosen({ FV: [0] }), PAIR, 0.05, 0.5);
  assert.deepEqual(up["FV"][0], [0.05, 0]);
  const phone = keys.move({ open: OPEN }, chosen({ open: [0] }), PHONE, -0.5, 0.5);
  assert.deepEqual(phone["open"][0], [-0.5, 0.5]);
});

test("a key that is added beyond the end takes the end along", () => {
  const { keys: list, index } = keys.insert(FV, [0.8, 0.5], PAIR);
  assert.deepEqual(list.slice(index), [
    [0.8, 0.5],
    [0.95, 0],
  ]);
  assertDrawable(list);
  assertDrawable(keys.insert(FV, [1, 0.7], PAIR).keys);
  assertDrawable(keys.insert(OPEN, [0, 0.7], PAIR).keys);
});

test("a key that is added on another is that one, moved", () => {
  const { keys: list, index } = keys.insert(FV, [0.15, 0.4], PAIR);
  assert.equal(list.length, FV.length);
  assert.deepEqual(list[index], [0.15, 0.4]);
});

test("deleting keeps the resting ends; a curve without a peak is no curve", () => {
  const some = keys.remove(both(), chosen({ FV: [0, 1], open: [1] }), PAIR);
  assert.deepEqual(some["FV"], [
    [0, 0],
    [0.28, 1],
    [0.62, 0],
  ]);
  assert.ok(!("open" in some));
  assert.ok(!("FV" in keys.remove(both(), chosen({ FV: [0, 1, 2, 3] }), PAIR)));
});

test("mirrored twice, a whole curve is what it was; of some keys the middle stays", () => {
  const all = keys.everything(both(), ["FV"]);
  const once = keys.mirror(both(), all, PAIR);
  assert.deepEqual(once["FV"], [
    [0.38, 0],
    [0.72, 1],
    [0.85, 1],
    [1, 0],
  ]);
  assert.deepEqual(keys.mirror(once, all, PAIR)["FV"], FV);
  const some = keys.mirror(both(), chosen({ FV: [1, 2] }), PAIR);
  assert.deepEqual(some["FV"], FV);
});

test("scaled weights stop at 1, and stretched times stay in order", () => {
  const strong = keys.scaleValues(both(), keys.everything(both(), ["open"]), PAIR, 3);
  assert.deepEqual(strong["open"][1], [0.71, 1]);
  const wide = keys.scaleTimes(both(), chosen({ FV: [1, 2] }), PAIR, 20);
  assertDrawable(wide["FV"]);
});

test("pasted keys win where both lie, and the curve still rests at its ends", () => {
  const pasted = keys.paste(
    FV,
    [
      [0.1, 0.3],
      [0.3, 0.4],
    ],
    PAIR,
  );
  assert.deepEqual(pasted, [
    [0, 0],
    [0.1, 0.3],
    [0.3, 0.4],
    [0.62, 0],
  ]);
  const single: Key[] = [
    [0.2, 0.5],
    [0.9, 0.5],
  ];
  assertDrawable(keys.paste([], single, PAIR));
});

test("a typed key goes as far as it may", () => {
  assert.deepEqual(keys.place(FV, 1, [0.9, 2], PAIR)[1], [0.279, 1]);
  assert.deepEqual(keys.place(FV, 3, [0.7, 0.5], PAIR)[3], [0.7, 0]);
});

test("what is near pulls, and the nearest pulls most", () => {
  assert.equal(keys.snap(0.51, [0, 0.5, 1], 0.02), 0.5);
  assert.equal(keys.snap(0.53, [0, 0.5, 1], 0.02), 0.53);
  assert.equal(keys.snap(0.503, [0.5, 0.504], 0.02), 0.504);
});

test("between keys a weight lies on their line; outside there is none", () => {
  assert.equal(keys.valueAt(FV, 0.45), 0.5);
  assert.equal(keys.valueAt(FV, 0.7), 0);
  assert.equal(keys.valueAt(FV, 0), 0);
});

test("whatever is done to a curve, in any order, it can be drawn in the set", () => {
  // A small generator of chance, so that a failure can be seen again.
  let seed = 7;
  const chance = () => {
    seed = (seed * 1103515245 + 12345) % 2147483648;
    return seed / 2147483648;
  };
  for (let round = 0; round < 300; round++) {
    let curves: Curves = both();
    const done: string[] = [];
    for (let step = 0; step < 12; step++) {
      const names = Object.keys(curves);
      if (!names.length) break;
      const name = names[Math.floor(chance() * names.length)];
      const picked = curves[name].flatMap((_, index) => (chance() < 0.4 ? [index] : []));
      const some = picked.length ? chosen({ [name]: picked }) : keys.everything(curves, [name]);
      const kind = Math.floor(chance() * 6);
      done.push(`${kind} ${name} ${picked}`);
      if (kind === 0) curves = keys.move(curves, some, PAIR, chance() * 2 - 1, chance() * 2 - 1);
      else if (kind === 1) curves = keys.mirror(curves, some, PAIR);
      else if (kind === 2) curves = keys.scaleTimes(curves, some, PAIR, chance() * 3);
      else if (kind === 3) curves = keys.scaleValues(curves, some, PAIR, chance() * 3);
      else if (kind === 4) curves = keys.remove(curves, some, PAIR);
      else
        curves = { ...curves, [name]: keys.insert(curves[name], [chance(), chance()], PAIR).keys };
      for (const list of Object.values(curves))
        assert.doesNotThrow(
          () => assertDrawable(list),
          `${done.join("; ")}: ${JSON.stringify(list)}`,
        );
    }
  }
});

test("the edge of a frame goes where it is held, and what it holds goes along", () => {
  const picked = chosen({ FV: [1, 2], open: [1] });
  const frame = frameOf(both(), picked) as Frame;
  assert.deepEqual(frame, { times: [0.15, 0.71], values: [0.46, 1] });
  const wide = stretch(both(), picked, PAIR, frame, "right", 0.99);
  assert.deepEqual(wide["open"][1], [0.99, 0.46]);
  assert.deepEqual(wide["FV"][1], [0.15, 1]);
  const weak = stretch(both(), picked, PAIR, frame, "top", 0.5);
  assert.deepEqual([weak["FV"][1][1], weak["open"][1][1]], [0.5, 0.23]);
  for (const list of [...Object.values(wide), ...Object.values(weak)]) assertDrawable(list);
  assert.equal(frameOf(both(), chosen({ FV: [1] })), null);
});

test("of several poses the first that is clearly seen is edited first", () => {
  assert.equal(keys.mostSeen({ open: OPEN, FV }), "open");
  const faint: Key[] = [
    [0, 0],
    [0.5, 0.1],
    [1, 0],
  ];
  assert.equal(keys.mostSeen({ open: faint, FV }), "FV");
  assert.equal(keys.mostSeen({ open: faint }), "open");
  assert.equal(keys.mostSeen({}), "");
});
