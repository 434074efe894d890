/** The rows of the studio's timeline, the lanes of its curves, and what lies under a pointer. */

import { paint } from "../../shared/paint.ts";
import { layOut, type Row } from "../../shared/rows.ts";
import type { Scale } from "../../shared/scale.ts";
import type { Span } from "../../shared/spans.ts";

/** Pixels around the edge of a phone that take hold of it. */
const EDGE = 5;

export interface Lane {
  control: number;
  row: Row;
}

export function rowsOf(height: number, has: { overview: boolean; wave: boolean }): Row[] {
  return layOut(height, has);
}

/** Pixels that the lane of the chosen control has at least, where there is room. */
const CHOSEN = 64;

/** One lane for each control that is shown, the chosen one's the tallest; or all in one. */
export function lanesOf(rows: Row[], shown: number[], apart: boolean, chosen: number): Lane[] {
  const row = rows[rows.length - 1];
  if (!apart || !shown.length) return shown.map((control) => ({ control, row: paint.inside(row) }));
  const even = row.height / shown.length;
  const tall = shown.includes(chosen) ? Math.max(even, Math.min(CHOSEN, row.height / 2)) : even;
  const rest = (row.height - tall) / Math.max(shown.length - 1, 1);
  let top = row.top;
  return shown.map((control) => {
    const height = control === chosen ? tall : shown.includes(chosen) ? rest : even;
    const lane = { ...row, top: top + 3, height: Math.max(height - 6, 4) };
    top += height;
    return { control, row: lane };
  });
}

/** The phone whose end lies at `x`: -1 for the start of the first, null for none. */
export function edgeAt(phones: Span[], scale: Scale, x: number): number | null {
  let best: number | null = null;
  let least = EDGE;
  const weigh = (time: number, phone: number) => {
    const far = Math.abs(scale.x(time) - x);
    if (far <= least) [best, least] = [phone, far];
  };
  if (phones.length) weigh(phones[0].start, -1);
  phones.forEach(({ end }, phone) => weigh(end, phone));
  return best;
}

/** How far an edge may go: no phone gets shorter than a hundredth of a second. */
export function roomOf(phones: Span[], edge: number, shortest = 0.01): [number, number] {
  if (edge < 0) return [-Infinity, phones[0].end - shortest];
  const { start } = phones[edge];
  const next = phones[edge + 1];
  return [start + shortest, next ? next.end - shortest : Infinity];
}

/** Phones and words with one edge moved, as they will be. */
export function movedEdge(spans: Span[], from: number, to: number): Span[] {
  const near = (time: number) => Math.abs(time - from) < 1e-4;
  return spans.map((span) => ({
    ...span,
    start: near(span.start) ? to : span.start,
    end: near(span.end) ? to : span.end,
  }));
}
