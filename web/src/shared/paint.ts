/** How the timeline is drawn. What stands still is kept between pictures; the rest is little. */

import type { Range } from "./clock.ts";
import { frameCount, type Curves } from "./curves.ts";
import type { Ink } from "./ink.ts";
import { niceStep, rulerTime } from "./format.ts";
import { stroke } from "./palette.ts";
import type { Hit, Row, RowName } from "./rows.ts";
import type { Scale } from "./scale.ts";
import { lastStart, spanAt, type Span } from "./spans.ts";
import { extent, type Peaks } from "./wav.ts";

/** What a timeline shows of a line. */
export interface Tracks {
  controls: Curves;
  words: Span[];
  phones: Span[];
}

export interface Shown {
  hidden: Set<number>;
  highlighted: number | null;
  /** How strongly the others are seen beside it. */
  others?: number;
}

export interface Scene {
  performance: Tracks;
  peaks: Peaks | null;
  rows: Row[];
  scale: Scale;
  shown: Shown;
  ink: Ink;
  range: Range | null;
}

type Context = CanvasRenderingContext2D;

/** Pixels below which a word or phone is not drawn: a grey mass would say nothing. */
const LEGIBLE = 2;

export const paint = {
  curve,
  inside,
  level,
  line,
  rule,

  row(context: Context, scene: Scene, row: Row): void {
    PAINTERS[row.name](context, scene, row);
  },

  still(context: Context, scene: Scene): void {
    for (const row of scene.rows) PAINTERS[row.name](context, scene, row);
  },

  moving(context: Context, scene: Scene, time: number, hover: Hit | null): void {
    const { performance, rows, scale, ink } = scene;
    if (scene.range) shade(context, scene, scene.range);
    for (const row of rows) {
      if (row.name !== "words" && row.name !== "phones") continue;
      const tier = performance[row.name];
      const now = tier[spanAt(tier, time)];
      if (now) cell(context, scene, row, now, ink.soft, ink.text);
      if (hover?.row === row.name && hover.span) outline(context, scene, row, hover.span);
    }
    const overview = rows.find((row) => row.name === "overview");
    const top = overview ? overview.height : 0;
    if (hover) line(context, scale.x(hover.time), top, bottom(rows), ink.line);
    const x = scale.x(time);
    context.fillStyle = ink.playhead;
    context.fillRect(Math.round(x) - 0.75, top, 1.5, bottom(rows) - top);
    handle(context, x, top);
    if (overview) {
      const { start, end } = scale.whole;
      context.fillRect(((time - start) / (end - start)) * scale.width - 0.5, 0, 1, top);
    }
  },
};

const PAINTERS: Record<RowName, (context: Context, scene: Scene, row: Row) => void> = {
  overview(context, { peaks, scale, ink }, row) {
    const { start, end } = scale.whole;
    const per = (end - start) / scale.width;
    const middle = row.top + row.height / 2;
    context.fillStyle = ink.muted;
    context.globalAlpha = 0.55;
    for (let x = 0; x < scale.width; x++) {
      const at = start + x * per;
      const [low, high] = peaks ? extent(peaks, at, at + per) : [0, 0];
      const tall = Math.max(((high - low) / 2) * (row.height - 6), 0.5);
      context.fillRect(x, middle - tall / 2, 1, tall);
    }
    context.globalAlpha = 1;
    const from = ((scale.start - start) / (end - start)) * scale.width;
    const wide = Math.max((scale.span / (end - start)) * scale.width, 3);
    context.fillStyle = ink.soft;
    context.fillRect(from, row.top, wide, row.height);
    context.strokeStyle = ink.accent;
    context.lineWidth = 1;
    context.strokeRect(from + 0.5, row.top + 0.5, wide - 1, row.height - 1);
  },

  ruler(context, { scale, ink }, row) {
    const step = niceStep((72 / scale.width) * scale.span);
    context.font = `10px ${ink.font}`;
    context.textBaseline = "middle";
    context.textAlign = "left";
    for (let mark = Math.ceil(scale.start / step) * step; mark <= scale.end; mark += step) {
      const x = scale.x(mark);
      line(context, x, row.top + 5, row.top + row.height, ink.line);
      context.fillStyle = ink.muted;
      context.fillText(rulerTime(mark, step), x + 4, row.top + row.height / 2 + 1);
    }
    rule(context, scale.width, row.top + row.height, ink.line);
  },

  wave(context, { peaks, scale, ink }, row) {
    if (!peaks) return;
    const middle = row.top + row.height / 2;
    const tall = row.height / 2 - 3;
    const loudest = Math.max(extent(peaks, 0, Number.MAX_VALUE)[1], 0.05);
    context.fillStyle = ink.wave;
    const per = scale.span / scale.width;
    for (let x = 0; x < scale.width; x += 0.5) {
      const at = scale.time(x);
      const [low, high] = extent(peaks, at, at + per / 2);
      const up = Math.min(high / loudest, 1) * tall;
      const down = Math.min(-low / loudest, 1) * tall;
      context.fillRect(x, middle - up, 0.5, Math.max(up + down, 0.75));
    }
  },

  words(context, scene, row) {
    tier(context, scene, row, scene.performance.words, scene.ink.text);
  },

  phones(context, scene, row) {
    tier(context, scene, row, scene.performance.phones, scene.ink.muted);
  },

  curves(context, scene, row) {
    const { performance, scale, shown, ink } = scene;
    const inner = inside(row);
    for (const share of [0, 0.5, 1])
      rule(context, scale.width, inner.top + share * inner.height, ink.line, share === 0.5);
    performance.controls.names.forEach((_, index) => {
      if (!shown.hidden.has(index) && index !== shown.highlighted)
        curve(context, scene, inner, index);
    });
    if (shown.highlighted !== null) curve(context, scene, inner, shown.highlighted);
  },
};

/** The part of a row in which curves are drawn. */
function inside(row: Row): Row {
  return { ...row, top: row.top + 8, height: row.height - 14 };
}

/** The height at which a weight lies. */
function level(row: Row, value: number): number {
  return row.top + (1 - Math.min(Math.max(value, 0), 1.05)) * row.height;
}

function tier(context: Context, scene: Scene, row: Row, spans: Span[], colour: string): void {
  const { scale, ink } = scene;
  rule(context, scale.width, row.top, ink.line);
  for (let index = Math.max(lastStart(spans, scale.start), 0); index < spans.length; index++) {
    if (spans[index].start > scale.end) break;
    if (scale.x(spans[index].end) - scale.x(spans[index].start) < LEGIBLE) continue;
    cell(context, scene, row, spans[index], "", colour);
  }
  rule(context, scale.width, row.top + row.height, ink.line);
}

function cell(
  context: Context,
  { scale, ink }: Scene,
  row: Row,
  span: Span,
  fill: string,
  text: string,
): void {
  const left = scale.x(span.start);
  const wide = scale.x(span.end) - left;
  if (fill) {
    for (const colour of [ink.page, fill]) {
      context.fillStyle = colour;
      context.fillRect(left, row.top + 1, wide, row.height - 1);
    }
  }
  line(context, left, row.top, row.top + row.height, ink.line);
  line(context, left + wide, row.top, row.top + row.height, ink.line);
  context.font = `${scale.width < 480 ? 10 : 11.5}px ${ink.font}`;
  context.textBaseline = "middle";
  context.textAlign = "center";
  if (context.measureText(span.label).width > wide - 4) return;
  context.globalAlpha = span.label === "sil" ? 0.5 : 1;
  context.fillStyle = text;
  const from = Math.max(left, 0);
  const to = Math.min(left + wide, scale.width);
  context.fillText(span.label, (from + to) / 2, row.top + row.height / 2 + 0.5);
  context.globalAlpha = 1;
}

function outline(context: Context, { scale, ink }: Scene, row: Row, span: Span): void {
  const left = scale.x(span.start);
  context.strokeStyle = ink.accent;
  context.lineWidth = 1;
  context.strokeRect(left + 0.5, row.top + 0.5, scale.x(span.end) - left - 1, row.height - 1);
}

function curve(context: Context, scene: Scene, row: Row, index: number): void {
  const { scale, shown, ink } = scene;
  const controls = scene.performance.controls;
  const width = controls.names.length;
  const last = frameCount(controls) - 1;
  const frame = (time: number) => (time - controls.start) * controls.rate;
  if (last < 0) return;
  const first = Math.min(Math.max(Math.floor(frame(scale.start)), 0), last);
  const end = Math.min(Math.ceil(frame(scale.end)), last);
  const { colour, dash } = stroke(index, ink.dark);
  const highlighted = shown.highlighted === index;
  context.beginPath();
  const raw = (at: number) => controls.values[Math.min(Math.max(at, 0), last) * width + index];
  const x = (at: number) => scale.x(controls.start + at / controls.rate);
  const y = (value: number) => level(row, value);
  const stride = Math.floor((end - first) / scale.width);
  for (let at = first; at <= end && stride > 1; at += stride) {
    const [low, high] = bounds(raw, at, Math.min(at + stride, last + 1));
    context.lineTo(x(at), y(high));
    context.lineTo(x(at), y(low));
  }
  for (let at = first; at <= end && stride <= 1; at++) {
    // Where it rests at zero it is left out: the curves there would only hide each other.
    if (raw(at - 1) === 0 && raw(at) === 0 && raw(at + 1) === 0) continue;
    const begins = raw(at) === 0 && raw(at - 1) === 0;
    context[begins ? "moveTo" : "lineTo"](x(at), y(raw(at)));
  }
  context.strokeStyle = colour;
  context.lineJoin = "round";
  context.lineWidth = highlighted ? 2.5 : 1.5;
  context.globalAlpha = shown.highlighted !== null && !highlighted ? (shown.others ?? 0.25) : 1;
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function bounds(raw: (at: number) => number, from: number, to: number): [number, number] {
  let [low, high] = [raw(from), raw(from)];
  for (let at = from; at < to; at++) {
    low = Math.min(low, raw(at));
    high = Math.max(high, raw(at));
  }
  return [low, high];
}

function shade(context: Context, { scale, ink, rows }: Scene, range: Range): void {
  const top = rows.find((row) => row.name === "ruler")?.top ?? 0;
  const left = scale.x(range.start);
  const right = scale.x(range.end);
  context.fillStyle = ink.soft;
  context.fillRect(left, top, right - left, bottom(rows) - top);
  line(context, left, top, bottom(rows), ink.accent);
  line(context, right, top, bottom(rows), ink.accent);
}

function handle(context: Context, x: number, top: number): void {
  context.beginPath();
  context.moveTo(x - 5, top);
  context.lineTo(x + 5, top);
  context.lineTo(x, top + 7);
  context.fill();
}

function line(context: Context, x: number, top: number, low: number, colour: string): void {
  context.fillStyle = colour;
  context.fillRect(Math.round(x), top, 1, low - top);
}

function rule(context: Context, width: number, y: number, colour: string, faint = false): void {
  context.globalAlpha = faint ? 0.5 : 1;
  context.fillStyle = colour;
  context.fillRect(0, Math.round(y), width, 1);
  context.globalAlpha = 1;
}

function bottom(rows: Row[]): number {
  const last = rows[rows.length - 1];
  return last.top + last.height;
}
