/**
 * The curve near the keys, for display: as the engine's last stage makes it
 * (`lipwright/engines/bigram/softening.py`; a fixture holds the two equal).
 */

import type { Key } from "./keys.ts";

export type Spline = "soften" | "bspline" | "pchip" | "linear";

const HALVINGS = 30;

/** Sample keys at some times, in order; `softness` is the half-width of the kernel, seconds. */
export function sampleKeys(
  keys: Key[],
  spline: Spline,
  softness: number,
  times: ArrayLike<number>,
): Float64Array {
  if (keys.length < 2) return new Float64Array(times.length).fill(keys[0]?.[1] ?? 0);
  if (spline === "pchip") return pchip(keys, times);
  if (spline === "bspline") return bspline(keys, times);
  const values = linear(keys, times);
  if (spline === "soften" && softness > 0) {
    soften(keys, softness, times, values);
    for (let at = 0; at < values.length; at++) values[at] = clamp(values[at]);
  }
  return values;
}

const clamp = (value: number) => Math.min(Math.max(value, 0), 1);

/** The index of the interval of keys that holds a time. */
function interval(keys: Key[], time: number, from: number): number {
  let at = from;
  while (at < keys.length - 2 && keys[at + 1][0] <= time) at++;
  return at;
}

function linear(keys: Key[], times: ArrayLike<number>): Float64Array {
  const result = new Float64Array(times.length);
  let at = 0;
  for (let index = 0; index < times.length; index++) {
    at = interval(keys, times[index], at);
    const [t0, v0] = keys[at];
    const [t1, v1] = keys[at + 1];
    result[index] = v0 + ((times[index] - t0) / (t1 - t0)) * (v1 - v0);
  }
  return result;
}

/** Add what convolution with a triangle adds at each bend. */
function soften(keys: Key[], width: number, times: ArrayLike<number>, values: Float64Array): void {
  const slope = (at: number) => (keys[at + 1][1] - keys[at][1]) / (keys[at + 1][0] - keys[at][0]);
  for (let at = 1; at < keys.length - 1; at++) {
    const bend = slope(at) - slope(at - 1);
    if (Math.abs(bend) <= 1e-12) continue;
    const scale = bend / (6 * width * width);
    for (let index = 0; index < times.length; index++) {
      const depth = width - Math.abs(times[index] - keys[at][0]);
      if (depth > 0) values[index] += scale * depth ** 3;
    }
  }
}

function pchip(keys: Key[], times: ArrayLike<number>): Float64Array {
  const steps = keys.slice(1).map(([time], at) => time - keys[at][0]);
  const slopes = keys.slice(1).map(([, value], at) => (value - keys[at][1]) / steps[at]);
  const tangents = new Float64Array(keys.length);
  for (let at = 1; at < keys.length - 1; at++) {
    const [before, after] = [slopes[at - 1], slopes[at]];
    if (before * after <= 0) continue;
    const near = 2 * steps[at] + steps[at - 1];
    const far = steps[at] + 2 * steps[at - 1];
    tangents[at] = ((near + far) * before * after) / (near * after + far * before);
  }
  const result = new Float64Array(times.length);
  let at = 0;
  for (let index = 0; index < times.length; index++) {
    at = interval(keys, times[index], at);
    const t = times[index] - keys[at][0];
    const square = (3 * slopes[at] - 2 * tangents[at] - tangents[at + 1]) / steps[at];
    const cube = (tangents[at] - 2 * slopes[at] + tangents[at + 1]) / steps[at] ** 2;
    result[index] = keys[at][1] + t * (tangents[at] + t * (square + t * cube));
  }
  return result;
}

/** The keys as control points of a uniform cubic B-spline, solved for time. */
function bspline(keys: Key[], times: ArrayLike<number>): Float64Array {
  const points = [keys[0], keys[0], ...keys, keys[keys.length - 1], keys[keys.length - 1]];
  const cubic = (axis: 0 | 1, at: number, u: number) => {
    const [a, b, c, d] = [0, 1, 2, 3].map((more) => points[at + more][axis]);
    const v = 1 - u;
    return (
      (v ** 3 * a +
        (3 * u ** 3 - 6 * u ** 2 + 4) * b +
        (3 * v ** 3 - 6 * v ** 2 + 4) * c +
        u ** 3 * d) /
      6
    );
  };
  const result = new Float64Array(times.length);
  let at = 0;
  for (let index = 0; index < times.length; index++) {
    const joint = (place: number) => cubic(0, place, 0);
    while (at < points.length - 4 && joint(at + 1) <= times[index]) at++;
    let [low, high] = [0, 1];
    for (let halving = 0; halving < HALVINGS; halving++) {
      const middle = (low + high) / 2;
      if (cubic(0, at, middle) < times[index]) low = middle;
      else high = middle;
    }
    result[index] = clamp(cubic(1, at, (low + high) / 2));
  }
  return result;
}
