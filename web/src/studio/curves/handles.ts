/** The frame around several chosen keys: its edges scale them in time and weight. */

import type { Chosen, Curves, Domain, Key } from "./keys.ts";
import { isHeld, settle } from "./keys.ts";
import type { Plot } from "./plot.ts";

export type Handle = "left" | "right" | "top";

export interface Frame {
  times: [number, number];
  values: [number, number];
}

const REACH = 7;
/** Pixels between the keys and the frame. */
export const AIR = 10;

/** What the chosen keys span; nothing for fewer than two. */
export function frameOf(curves: Curves, chosen: Chosen): Frame | null {
  const keys = [...chosen].flatMap(([name, picked]) =>
    [...picked].map((index) => curves[name]?.[index]).filter((key): key is Key => Boolean(key)),
  );
  if (keys.length < 2) return null;
  const times = keys.map(([time]) => time);
  const values = keys.map(([, value]) => value);
  return {
    times: [Math.min(...times), Math.max(...times)],
    values: [Math.min(...values), Math.max(...values)],
  };
}

/** Where the handles of a frame are, in pixels. */
export function handlesOf(frame: Frame, plot: Plot): Record<Handle, { x: number; y: number }> {
  const [left, right] = frame.times.map((time) => plot.x(time));
  const [low, high] = frame.values.map((value) => plot.y(value));
  const middle = (low + high) / 2;
  return {
    left: { x: left - AIR, y: middle },
    right: { x: right + AIR, y: middle },
    top: { x: (left + right) / 2, y: high - AIR },
  };
}

export function handleAt(frame: Frame | null, plot: Plot, x: number, y: number): Handle | null {
  if (!frame) return null;
  for (const [name, at] of Object.entries(handlesOf(frame, plot)))
    if (Math.hypot(at.x - x, at.y - y) <= REACH) return name as Handle;
  return null;
}

/** Scale the chosen keys, so that the edge that is held lies at a time or a weight. */
export function stretch(
  curves: Curves,
  chosen: Chosen,
  domain: Domain,
  frame: Frame,
  handle: Handle,
  to: number,
): Curves {
  const [first, last] = frame.times;
  const still = handle === "left" ? last : first;
  const held = handle === "left" ? first : last;
  const byTime =
    handle === "top" || held === still ? 1 : Math.max((to - still) / (held - still), 0.02);
  const byValue = handle === "top" && frame.values[1] > 0 ? Math.max(to, 0) / frame.values[1] : 1;
  const round = (value: number) => Math.round(value * 1000) / 1000;
  const result = { ...curves };
  for (const [name, picked] of chosen) {
    const keys = curves[name];
    if (!keys) continue;
    const moved = keys.map((key, index): Key => {
      if (!picked.has(index)) return key;
      const time = still + (key[0] - still) * byTime;
      const value = isHeld(keys, index, domain) ? 0 : Math.min(key[1] * byValue, 1);
      return [round(Math.min(Math.max(time, domain.first), domain.last)), round(value)];
    });
    result[name] = settle(moved, domain);
  }
  return result;
}
