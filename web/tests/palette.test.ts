import assert from "node:assert/strict";
import { test } from "node:test";
import { STAGES, stageStroke } from "../src/studio/line/palette.ts";
import { ON_DARK, ON_LIGHT, stroke } from "../src/shared/palette.ts";

type Colour = [number, number, number];

/** Machado, Oliveira and Fernandes 2009, severity 1, on linear RGB. */
const EYES: Record<string, number[][]> = {
  normal: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

const times = (matrix: number[][], colour: number[]) =>
  matrix.map((row) => row.reduce((sum, each, index) => sum + each * colour[index], 0)) as Colour;

function linear(hex: string): Colour {
  return [1, 3, 5].map((at) => {
    const value = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  }) as Colour;
}

function oklab(rgb: Colour): Colour {
  const lms = times(
    [
      [0.4122214708, 0.5363325363, 0.0514459929],
      [0.2119034982, 0.6806995451, 0.1073969566],
      [0.0883024619, 0.2817188376, 0.6299787005],
    ],
    rgb.map((value) => Math.min(Math.max(value, 0), 1)),
  );
  return times(
    [
      [0.2104542553, 0.793617785, -0.0040720468],
      [1.9779984951, -2.428592205, 0.4505937099],
      [0.0259040371, 0.7827717662, -0.808675766],
    ],
    lms.map(Math.cbrt),
  );
}

function contrast(a: string, b: string): number {
  const light = (hex: string) => times([[0.2126, 0.7152, 0.0722]], linear(hex))[0] + 0.05;
  const ratio = light(a) / light(b);
  return Math.max(ratio, 1 / ratio);
}

for (const [theme, colours, page] of [
  ["dark", ON_DARK, "#131519"],
  ["light", ON_LIGHT, "#f4f4f2"],
] as const) {
  test(`every curve stands out from the ${theme} page`, () => {
    for (const colour of colours) assert.ok(contrast(colour, page) >= 3, colour);
  });

  for (const [eyes, matrix] of Object.entries(EYES))
    test(`the curves on the ${theme} page stay apart for ${eyes} eyes`, () => {
      const seen = colours.map((colour) => oklab(times(matrix, linear(colour))));
      for (const [index, a] of seen.entries())
        for (const b of seen.slice(index + 1))
          assert.ok(Math.hypot(...a.map((value, at) => value - b[at])) > 0.09);
    });
}

test("fifty curves have fifty strokes", () => {
  const strokes = Array.from({ length: 50 }, (_, index) => JSON.stringify(stroke(index, true)));
  assert.equal(new Set(strokes).size, 50);
});

for (const [theme, dark, page] of [
  ["dark", true, "#131519"],
  ["light", false, "#f4f4f2"],
] as const) {
  test(`the stages stay apart on the ${theme} page for all eyes`, () => {
    const colours = STAGES.map((name) => stageStroke(name, dark, false).colour);
    for (const matrix of Object.values(EYES)) {
      const seen = colours.map((colour) => oklab(times(matrix, linear(colour))));
      for (const [index, a] of seen.entries())
        for (const b of seen.slice(index + 1))
          assert.ok(Math.hypot(...a.map((value, at) => value - b[at])) > 0.09);
    }
  });

  test(`the publication's colours of the stages can be read on the ${theme} page`, () => {
    for (const name of STAGES)
      assert.ok(contrast(stageStroke(name, dark, true).colour, page) >= 3, name);
  });
}
