import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import type { Key } from "../src/studio/curves/keys.ts";
import { sampleKeys, type Spline } from "../src/studio/curves/sampling.ts";

interface Case {
  kind: Spline;
  softness: number;
  keys: Key[];
  rate: number;
  values: number[];
}

/** What the engine makes of the same keys; a test in Python holds the file equal to the engine. */
const fixture = JSON.parse(readFileSync(new URL("sampling.json", import.meta.url), "utf-8"));
const cases: Case[] = fixture.cases ?? fixture;

for (const { kind, softness, keys, rate, values } of cases)
  test(`${keys.length} keys, ${kind} ${softness}, are drawn as the engine samples them`, () => {
    const times = values.map((_, frame) => frame / rate);
    const drawn = sampleKeys(keys, kind, softness, times);
    values.forEach((value, frame) => {
      const found = drawn[frame];
      assert.ok(Math.abs(found - value) < 1e-6, `frame ${frame}: ${found} is not ${value}`);
    });
  });

test("all four kinds of spline are held", () => {
  assert.deepEqual([...new Set(cases.map(({ kind }) => kind))].sort(), [
    "bspline",
    "linear",
    "pchip",
    "soften",
  ]);
});
