import assert from "node:assert/strict";
import { test } from "node:test";
import { hit, layOut } from "../src/shared/rows.ts";
import { Scale } from "../src/shared/scale.ts";
import { neighbour, spanAt } from "../src/shared/spans.ts";

const phones = [
  { label: "p", start: 0, end: 0.1 },
  { label: "aa", start: 0.1, end: 0.3 },
  { label: "p", start: 0.5, end: 0.6 },
];
const words = [{ label: "pop", start: 0, end: 0.6 }];

function scaled(): Scale {
  const scale = new Scale({ start: -0.2, end: 3.8 });
  scale.width = 400;
  return scale;
}

test("a span begins at its start and is over at its end", () => {
  assert.equal(spanAt(phones, 0), 0);
  assert.equal(spanAt(phones, 0.1), 1);
  assert.equal(spanAt(phones, 0.3), -1);
  assert.equal(spanAt(phones, 0.55), 2);
  assert.equal(spanAt(phones, -1), -1);
  assert.equal(spanAt([], 0), -1);
});

test("the next mark is a later one, the one before an earlier one", () => {
  assert.equal(neighbour([0.05, 0.2, 0.55], 0.2, 1), 0.55);
  assert.equal(neighbour([0.05, 0.2, 0.55], 0.2, -1), 0.05);
  assert.equal(neighbour([0.05, 0.2, 0.55], 0.6, 1), undefined);
});

test("pixels and seconds are each other's inverse", () => {
  const scale = scaled();
  assert.equal(scale.x(-0.2), 0);
  assert.equal(scale.x(3.8), 400);
  assert.ok(Math.abs(scale.time(scale.x(1.23)) - 1.23) < 1e-12);
});

test("zooming keeps the time under the pointer, and nothing outside is ever shown", () => {
  const scale = scaled();
  scale.zoom(1, 100);
  assert.ok(Math.abs(scale.time(100) - 0.8) < 1e-12);
  assert.ok(Math.abs(scale.span - 1) < 1e-12);
  scale.pan(-10000);
  assert.equal(scale.start, -0.2);
  scale.pan(10000);
  assert.ok(Math.abs(scale.end - 3.8) < 1e-12);
  scale.zoom(99, 200);
  assert.ok(!scale.zoomed);
});

test("a playhead that leaves the page turns it", () => {
  const scale = scaled();
  scale.zoom(1, 0);
  assert.ok(!scale.follow(0.5));
  assert.ok(scale.follow(0.9));
  assert.ok(scale.start <= 0.9 && scale.end > 1.5);
});

test("the rows fill the height, without gaps", () => {
  for (const [height, has] of [
    [130, { overview: false, wave: true }],
    [240, { overview: true, wave: true }],
    [340, { overview: true, wave: false }],
  ] as const) {
    const rows = layOut(height, has);
    assert.equal(
      rows.some(({ name }) => name === "wave"),
      has.wave,
    );
    let top = 0;
    for (const row of rows) {
      assert.equal(row.top, top);
      top += row.height;
    }
    assert.equal(top, height);
  }
});

test("a pointer finds the phone or the word under it", () => {
  const scale = scaled();
  const rows = layOut(240, { overview: false, wave: true });
  const row = (name: string) => rows.find((each) => each.name === name)!;
  const at = (name: string, time: number) =>
    hit(scale.x(time), row(name).top + 2, rows, scale, { words, phones });
  assert.equal(at("phones", 0.2).span?.label, "aa");
  assert.equal(at("words", 0.2).span?.label, "pop");
  assert.equal(at("phones", 0.4).span, null);
  assert.equal(at("curves", 0.2).span, null);
  assert.ok(Math.abs(at("curves", 0.2).time - 0.2) < 1e-9);
});

test("the overview counts from the first to the last second, whatever is zoomed", () => {
  const scale = scaled();
  scale.zoom(0.5, 0);
  const rows = layOut(240, { overview: true, wave: true });
  const found = hit(200, 3, rows, scale, { words, phones });
  assert.equal(found.row, "overview");
  assert.ok(Math.abs(found.time - 1.8) < 1e-9);
});
