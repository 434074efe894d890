/** How the curve editor is drawn. */

import type { Ink } from "../../shared/ink.ts";
import { AIR, handlesOf, type Frame, type Handle } from "./handles.ts";
import type { Chosen, Curves, Key } from "./keys.ts";
import type { Plot } from "./plot.ts";
import { sampleKeys, type Spline } from "./sampling.ts";

export interface Stroke {
  colour: string;
  dash: number[];
}

export interface Drawing {
  plot: Plot;
  ink: Ink;
  curves: Curves;
  /** What lies beneath what is drawn: the set's own curves. */
  ghosts: Curves;
  /** Keys as they were before this drag. */
  before: Curves | null;
  active: string;
  chosen: Chosen;
  hovered: { name: string; index: number } | null;
  strokes: Map<string, Stroke>;
  spline: Spline;
  /** Half-width of each pose's kernel, in units of the axis. */
  softness: Map<string, number>;
  /** Where the phones meet, their names, and the edges of those named. */
  boundary: number | null;
  boundaryHot: boolean;
  stretches: { label: string; from: number; to: number }[];
  box: { x: number; y: number; width: number; height: number } | null;
  playhead: number | null;
  /** A place that a dragged key has snapped to. */
  pulled: { time: number | null; value: number | null };
  /** Around several chosen keys, and the handle of it under the pointer. */
  frame: Frame | null;
  handle: Handle | null;
}

type Context = CanvasRenderingContext2D;

const WIDE = 0.9;

export function paint(context: Context, drawing: Drawing): void {
  const { plot } = drawing;
  ground(context, drawing);
  context.save();
  context.beginPath();
  context.rect(plot.left - 15, 0, plot.right - plot.left + 31, plot.bottom + 15);
  context.clip();
  for (const [name, keys] of Object.entries(drawing.ghosts)) ghost(context, drawing, name, keys);
  if (drawing.before?.[drawing.active])
    ghost(context, drawing, drawing.active, drawing.before[drawing.active]);
  for (const name of Object.keys(drawing.curves))
    if (name !== drawing.active) curve(context, drawing, name, false);
  if (drawing.curves[drawing.active]) curve(context, drawing, drawing.active, true);
  for (const name of Object.keys(drawing.curves))
    if (name !== drawing.active) dots(context, drawing, name, false);
  if (drawing.curves[drawing.active]) dots(context, drawing, drawing.active, true);
  if (drawing.frame) handles(context, drawing, drawing.frame);
  context.restore();
  marks(context, drawing);
}

function ground(context: Context, drawing: Drawing): void {
  const { plot, ink, boundary, stretches } = drawing;
  context.fillStyle = ink.page;
  context.fillRect(0, 0, plot.width, plot.height);
  if (stretches.length > 1) {
    // The second phone lies on another ground, so that one sees where the sounds meet.
    const from = Math.max(plot.x(boundary ?? stretches[1].from), plot.left);
    const to = Math.min(plot.x(stretches[1].to), plot.right);
    context.fillStyle = ink.raised;
    context.globalAlpha = 0.45;
    if (to > from) context.fillRect(from, plot.top, to - from, plot.bottom - plot.top);
    context.globalAlpha = 1;
  }
  context.font = `10.5px ${ink.font}`;
  context.textBaseline = "middle";
  context.textAlign = "right";
  for (const value of [0, 0.25, 0.5, 0.75, 1]) {
    const y = Math.round(plot.y(value));
    context.fillStyle = ink.line;
    context.globalAlpha = value === 0 || value === 1 ? 1 : 0.55;
    context.fillRect(plot.left, y, plot.right - plot.left, 1);
    context.globalAlpha = 1;
    context.fillStyle = ink.muted;
    if (value % 0.5 === 0 || plot.bottom - plot.top > 190)
      context.fillText(String(value), plot.left - 8, y + 0.5);
  }
  const span = plot.to - plot.from;
  const step = [0.01, 0.02, 0.05, 0.1, 0.2, 0.25, 0.5].find(
    (each) => (each / span) * (plot.right - plot.left) >= 46,
  );
  context.textAlign = "center";
  for (let at = Math.ceil(plot.from / (step ?? 1)); at * (step ?? 1) <= plot.to + 1e-9; at++) {
    const time = at * (step ?? 1);
    const x = Math.round(plot.x(time));
    context.fillStyle = ink.line;
    const edge = Math.abs(time) < 1e-9 || Math.abs(time - 1) < 1e-9;
    context.globalAlpha = edge ? 1 : 0.45;
    context.fillRect(x, plot.top, 1, plot.bottom - plot.top);
    context.globalAlpha = 1;
    context.fillStyle = ink.muted;
    context.fillText(`${Math.round(time * 100) / 100}`, x, plot.bottom + 12);
  }
  for (const stretch of stretches) strip(context, drawing, stretch);
  if (boundary !== null) border(context, drawing, boundary);
}

function strip(
  context: Context,
  { plot, ink }: Drawing,
  stretch: { label: string; from: number; to: number },
): void {
  const ends = [stretch.from, stretch.to].map((time) => Math.round(plot.x(time)));
  const from = Math.max(ends[0], plot.left);
  const to = Math.min(ends[1], plot.right);
  if (to <= from) return;
  const top = plot.bottom + 22;
  context.fillStyle = ink.raised;
  context.beginPath();
  context.roundRect(from + 1, top, to - from - 2, 17, 3);
  context.fill();
  context.fillStyle = ink.text;
  context.font = `600 11.5px ${ink.font}`;
  context.textAlign = "center";
  if (to - from > 24) context.fillText(stretch.label, (from + to) / 2, top + 9);
}

function border(context: Context, { plot, ink, boundaryHot }: Drawing, boundary: number): void {
  const x = Math.round(plot.x(boundary));
  if (x < plot.left - 1 || x > plot.right + 1) return;
  context.strokeStyle = boundaryHot ? ink.accent : ink.muted;
  context.lineWidth = boundaryHot ? 2 : 1;
  context.setLineDash([4, 3]);
  context.beginPath();
  context.moveTo(x + 0.5, plot.top);
  context.lineTo(x + 0.5, plot.bottom + 20);
  context.stroke();
  context.setLineDash([]);
  context.fillStyle = boundaryHot ? ink.accent : ink.muted;
  context.beginPath();
  context.roundRect(x - 3, plot.bottom + 20, 7, 21, 3);
  context.fill();
}

function path(context: Context, plot: Plot, keys: Key[]): void {
  context.beginPath();
  keys.forEach(([time, value], index) =>
    context[index ? "lineTo" : "moveTo"](plot.x(time), plot.y(value)),
  );
}

function ghost(context: Context, drawing: Drawing, name: string, keys: Key[]): void {
  const { plot, strokes } = drawing;
  path(context, plot, keys);
  context.strokeStyle = strokes.get(name)?.colour ?? drawing.ink.muted;
  context.globalAlpha = name === drawing.active ? 0.7 : 0.25;
  context.lineWidth = 1;
  context.setLineDash([2, 4]);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function curve(context: Context, drawing: Drawing, name: string, active: boolean): void {
  const { plot, strokes, spline, softness } = drawing;
  const keys = drawing.curves[name];
  const { colour, dash } = strokes.get(name) ?? { colour: drawing.ink.text, dash: [] };
  const count = Math.max(Math.ceil(plot.right - plot.left), 2);
  const margin = (softness.get(name) ?? 0) + 1;
  const times = Float64Array.from({ length: count + 1 }, (_, at) => plot.time(plot.left + at));
  const whole: Key[] = [
    [keys[0][0] - margin, keys[0][1]],
    ...keys,
    [keys[keys.length - 1][0] + margin, keys[keys.length - 1][1]],
  ];
  const values = sampleKeys(
    spline === "bspline" || spline === "pchip" ? keys : whole,
    spline,
    softness.get(name) ?? 0,
    times,
  );
  context.strokeStyle = colour;
  if (active) {
    context.beginPath();
    values.forEach((value, at) => context.lineTo(plot.left + at, plot.y(value)));
    context.lineTo(plot.right, plot.y(0));
    context.lineTo(plot.left, plot.y(0));
    context.fillStyle = colour;
    context.globalAlpha = 0.1;
    context.fill();
    path(context, plot, keys);
    context.globalAlpha = 0.6;
    context.lineWidth = 1;
    context.stroke();
  }
  context.beginPath();
  let drawn = false;
  values.forEach((value, at) => {
    // Where a curve rests it is not drawn: nine of them would lie on each other.
    const rests = value === 0 && (values[at + 1] ?? 0) === 0;
    if (!rests) context[drawn ? "lineTo" : "moveTo"](plot.left + at, plot.y(value));
    drawn = !rests;
  });
  context.globalAlpha = active ? 1 : 0.6;
  context.lineWidth = active ? 2.25 : 1.5;
  context.lineJoin = "round";
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function dots(context: Context, drawing: Drawing, name: string, active: boolean): void {
  const { plot, ink, chosen, hovered, strokes } = drawing;
  const colour = strokes.get(name)?.colour ?? ink.text;
  drawing.curves[name].forEach(([time, value], index) => {
    const [x, y] = [plot.x(time), plot.y(value)];
    const picked = chosen.get(name)?.has(index) ?? false;
    const hot = hovered?.name === name && hovered.index === index;
    const size = active || picked ? 4.5 : 2.75;
    context.beginPath();
    if (active || picked) context.rect(x - size, y - size, 2 * size, 2 * size);
    else context.arc(x, y, size, 0, 7);
    context.fillStyle = picked ? ink.text : active ? ink.page : colour;
    context.globalAlpha = active || picked || hot ? 1 : 0.7;
    context.fill();
    context.strokeStyle = picked ? ink.text : colour;
    context.lineWidth = picked ? 1 : 1.75;
    if (active || picked) context.stroke();
    if (hot) {
      context.beginPath();
      context.arc(x, y, size + 4.5, 0, 7);
      context.strokeStyle = ink.accent;
      context.lineWidth = 1.5;
      context.stroke();
    }
    context.globalAlpha = 1;
  });
}

function handles(context: Context, { plot, ink, handle }: Drawing, frame: Frame): void {
  const [left, right] = frame.times.map((time) => plot.x(time));
  const [low, high] = frame.values.map((value) => plot.y(value));
  context.strokeStyle = ink.muted;
  context.lineWidth = 1;
  context.setLineDash([3, 3]);
  context.strokeRect(left - AIR, high - AIR, right - left + 2 * AIR, low - high + 2 * AIR);
  context.setLineDash([]);
  for (const [name, { x, y }] of Object.entries(handlesOf(frame, plot))) {
    context.beginPath();
    context.arc(x, y, 4.5, 0, 7);
    context.fillStyle = name === handle ? ink.accent : ink.panel;
    context.fill();
    context.strokeStyle = ink.text;
    context.lineWidth = 1.25;
    context.stroke();
  }
}

function marks(context: Context, drawing: Drawing): void {
  const { plot, ink, pulled, box, playhead } = drawing;
  context.fillStyle = ink.accent;
  if (pulled.time !== null)
    context.fillRect(Math.round(plot.x(pulled.time)), plot.top, WIDE, plot.bottom - plot.top);
  if (pulled.value !== null)
    context.fillRect(plot.left, Math.round(plot.y(pulled.value)), plot.right - plot.left, WIDE);
  if (playhead !== null && playhead >= plot.from && playhead <= plot.to) {
    context.fillStyle = ink.playhead;
    context.fillRect(plot.x(playhead) - 0.75, plot.top, 1.5, plot.bottom - plot.top);
  }
  if (!box) return;
  context.fillStyle = ink.soft;
  context.fillRect(box.x, box.y, box.width, box.height);
  context.strokeStyle = ink.accent;
  context.lineWidth = 1;
  context.strokeRect(box.x + 0.5, box.y + 0.5, box.width, box.height);
}
