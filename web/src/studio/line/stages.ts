/** The curves of the run-time stages, drawn over those of the result. */

import { frameCount, type Curves } from "../../shared/curves.ts";
import { paint } from "../../shared/paint.ts";
import type { Row } from "../../shared/rows.ts";
import type { Scale } from "../../shared/scale.ts";
import { unpack } from "../core/packed.ts";
import type { MotionView, StageCurve } from "../protocol.ts";
import type { Lane } from "./rows.ts";
import { partStroke, stageStroke, type StageName, type StageStroke } from "./palette.ts";

export interface Piece {
  times: Float32Array;
  values: Float32Array;
  /** The pair's number in the line; -1 for a curve of the whole line. */
  pair: number;
}

const kept = new WeakMap<StageCurve, Piece[]>();

/** The pieces of one control after one stage. */
export function piecesOf(motion: MotionView, stage: StageName, control: string): Piece[] {
  const curve = motion.stages
    .find(({ name }) => name === stage)
    ?.curves.find((each) => each.control === control);
  if (!curve) return [];
  const known = kept.get(curve);
  if (known) return known;
  const [times, values] = [unpack(curve.times), unpack(curve.values)];
  const starts = curve.breaks.length ? curve.breaks : [0];
  const pieces = starts.map((start, index) => ({
    times: times.subarray(start, starts[index + 1] ?? times.length),
    values: values.subarray(start, starts[index + 1] ?? values.length),
    pair: curve.pairs[index] ?? -1,
  }));
  kept.set(curve, pieces);
  return pieces;
}

export interface StageScene {
  motion: MotionView;
  control: string;
  on: Set<StageName>;
  dark: boolean;
  figures: boolean;
  scale: Scale;
  row: Row;
}

export function paintStages(context: CanvasRenderingContext2D, scene: StageScene): void {
  const { motion, control, on, dark, figures } = scene;
  if (on.has("stitched") && !on.has("placed"))
    for (const piece of piecesOf(motion, "placed", control))
      trace(context, scene, piece, partStroke(dark, figures));
  for (const stage of ["placed", "stitched", "smoothed", "constrained", "limited"] as const) {
    if (!on.has(stage)) continue;
    const stroke = stageStroke(stage, dark, figures);
    for (const piece of piecesOf(motion, stage, control)) {
      trace(context, scene, piece, stroke);
      if (stage === "placed" || stage === "limited") keys(context, scene, piece, stroke.colour);
    }
  }
}

function trace(
  context: CanvasRenderingContext2D,
  { scale, row }: StageScene,
  { times, values }: Piece,
  { colour, dash, wide }: StageStroke,
): void {
  context.beginPath();
  for (let at = 0; at < times.length; at++) {
    if (times[at + 1] < scale.start || times[at - 1] > scale.end) continue;
    const rests = values[at] === 0 && values[at - 1] === 0;
    context[rests ? "moveTo" : "lineTo"](scale.x(times[at]), paint.level(row, values[at]));
  }
  context.strokeStyle = colour;
  context.lineWidth = wide;
  context.lineJoin = "round";
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

function keys(
  context: CanvasRenderingContext2D,
  { scale, row }: StageScene,
  { times, values }: Piece,
  colour: string,
): void {
  context.fillStyle = colour;
  for (let at = 0; at < times.length; at++) {
    if (times[at] < scale.start || times[at] > scale.end || values[at] === 0) continue;
    context.fillRect(scale.x(times[at]) - 2, paint.level(row, values[at]) - 2, 4, 4);
  }
}

/** One control of a result, as it is exported. */
export function paintResult(
  context: CanvasRenderingContext2D,
  controls: Curves,
  { control, row }: Lane,
  scale: Scale,
  { colour, dash, wide }: StageStroke,
): void {
  const width = controls.names.length;
  const last = frameCount(controls) - 1;
  const frame = (time: number) => Math.round((time - controls.start) * controls.rate);
  const from = Math.max(frame(scale.start) - 1, 0);
  const to = Math.min(frame(scale.end) + 1, last);
  context.beginPath();
  for (let at = from; at <= to; at++) {
    const value = controls.values[at * width + control];
    const rests = value === 0 && (controls.values[(at - 1) * width + control] ?? 0) === 0;
    const x = scale.x(controls.start + at / controls.rate);
    context[rests ? "moveTo" : "lineTo"](x, paint.level(row, value));
  }
  context.strokeStyle = colour;
  context.lineWidth = wide;
  context.lineJoin = "round";
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}
