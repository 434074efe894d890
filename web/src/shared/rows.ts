/** The rows of the timeline, from top to bottom, and what lies under a pointer. */

import type { Scale } from "./scale.ts";
import { spanAt, type Span } from "./spans.ts";

export type RowName = "overview" | "ruler" | "wave" | "words" | "phones" | "curves";

export interface Row {
  name: RowName;
  top: number;
  height: number;
}

/** Share the height out: text rows as they need it, the rest to waveform and curves. */
export function layOut(height: number, has: { overview: boolean; wave: boolean }): Row[] {
  const fixed: [RowName, number][] = [];
  if (has.overview) fixed.push(["overview", 18]);
  fixed.push(["ruler", 18]);
  const text: [RowName, number][] = [
    ["words", 22],
    ["phones", 22],
  ];
  const used = [...fixed, ...text].reduce((sum, [, each]) => sum + each, 0);
  const rest = Math.max(height - used, 40);
  const wave = has.wave ? Math.min(Math.max(Math.round(rest * 0.3), 24), 72) : 0;
  const all: [RowName, number][] = [...fixed];
  if (wave) all.push(["wave", wave]);
  all.push(...text, ["curves", rest - wave]);
  let top = 0;
  return all.map(([name, each]) => {
    const row = { name, top, height: each };
    top += each;
    return row;
  });
}

export interface Hit {
  row: RowName;
  time: number;
  span: Span | null;
}

export function hit(
  x: number,
  y: number,
  rows: Row[],
  scale: Scale,
  tiers: { words: Span[]; phones: Span[] },
): Hit {
  const row = rows.find((each) => y < each.top + each.height) ?? rows[rows.length - 1];
  if (row.name === "overview") {
    const { start, end } = scale.whole;
    return { row: row.name, time: start + (x / scale.width) * (end - start), span: null };
  }
  const time = scale.time(x);
  const tier = row.name === "words" || row.name === "phones" ? tiers[row.name] : [];
  return { row: row.name, time, span: tier[spanAt(tier, time)] ?? null };
}
