/** How the line is drawn: rows, lanes, stages, and what is chosen or corrected in it. */

import { sample, type Curves } from "../../shared/curves.ts";
import { paint, type Scene } from "../../shared/paint.ts";
import type { Row } from "../../shared/rows.ts";
import type { EditView, MotionView } from "../protocol.ts";
import type { Looks } from "./canvas.ts";
import type { Lane } from "./rows.ts";
import { paintResult, paintStages } from "./stages.ts";

export interface View {
  scene: Scene;
  looks: Looks;
  lanes: Lane[];
  motion: MotionView | null;
  /** The controls of the version that is held beside this one. */
  other: Curves | null;
  edits: EditView[];
  /** The phone that is chosen, and the edge under the pointer. */
  chosen: number | null;
  edge: number | null;
  /** Where it was asked why. */
  asked: { time: number; control: string } | null;
}

type Context = CanvasRenderingContext2D;

/** All that stands still while the line plays. */
export function paintStill(context: Context, view: View): void {
  for (const row of view.scene.rows) {
    const plain = row.name !== "curves" || !(view.looks.apart || view.looks.on.size);
    if (!plain) paintCurves(context, view, row);
    else paint.row(context, view.scene, row);
    if (plain && row.name === "curves") paintOther(context, view);
  }
  paintEdits(context, view);
}

function paintCurves(context: Context, view: View, row: Row): void {
  const { scene, looks, lanes, motion } = view;
  const { scale, ink } = scene;
  const { names } = scene.performance.controls;
  const own = lanes.find(({ control }) => names[control] === looks.control);
  if (!looks.apart) {
    const inner = paint.inside(row);
    for (const share of [0, 0.5, 1])
      paint.rule(context, scale.width, inner.top + share * inner.height, ink.line);
  }
  for (const lane of lanes) {
    if (looks.apart) paintLane(context, view, lane);
    if (lane !== own || !looks.on.size) paint.curve(context, scene, lane.row, lane.control);
  }
  if (!own || !motion || !looks.on.size) return paintOther(context, view);
  const { control, on, figures } = looks;
  paintStages(context, { motion, control, on, dark: ink.dark, figures, scale, row: own.row });
  const result = { colour: ink.text, dash: [], wide: 2 };
  paintResult(context, scene.performance.controls, own, scale, result);
  paintOther(context, view);
}

/** The chosen control of the version that this one is compared with. */
function paintOther(context: Context, { scene, looks, lanes, other }: View): void {
  const { names } = scene.performance.controls;
  const own = lanes.find(({ control }) => names[control] === looks.control);
  const control = other?.names.indexOf(looks.control) ?? -1;
  if (!own || !other || control < 0) return;
  const style = { colour: scene.ink.text, dash: [2, 4], wide: 1.5 };
  paintResult(context, other, { control, row: own.row }, scene.scale, style);
}

function paintLane(context: Context, { scene, looks }: View, { control, row }: Lane): void {
  const { scale, ink } = scene;
  const name = scene.performance.controls.names[control];
  if (name === looks.control) {
    context.fillStyle = ink.raised;
    context.globalAlpha = 0.6;
    context.fillRect(0, row.top - 2, scale.width, row.height + 4);
    context.globalAlpha = 1;
  }
  paint.rule(context, scale.width, row.top + row.height + 2, ink.line);
  if (row.height < 13) return;
  context.font = `10.5px ${ink.font}`;
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillStyle = ink.muted;
  context.fillText(name, 4, row.top);
}

/** Phones that are corrected in this line. */
function paintEdits(context: Context, { scene, edits }: View): void {
  const { scale, ink } = scene;
  const row = scene.rows.find(({ name }) => name === "phones");
  if (!row) return;
  context.fillStyle = ink.accent;
  for (const { lost, start, end } of edits) {
    if (lost || end < scale.start || start > scale.end) continue;
    const wide = Math.max(scale.x(end) - scale.x(start) - 4, 2);
    context.fillRect(scale.x(start) + 2, row.top + row.height - 4, wide, 2.5);
  }
}

/** The phone that is chosen, the edge that can be dragged, the instant that was asked about. */
export function paintChosen(context: Context, view: View): void {
  const { scale, ink, performance, rows } = view.scene;
  const row = rows.find(({ name }) => name === "phones");
  const span = view.chosen === null ? null : performance.phones[view.chosen];
  if (row && span) {
    context.strokeStyle = ink.accent;
    context.lineWidth = 2;
    const x = scale.x(span.start);
    context.strokeRect(x + 1, row.top + 1.5, scale.x(span.end) - x - 2, row.height - 3);
  }
  if (row && view.edge !== null) {
    const { phones } = performance;
    const time = view.edge < 0 ? phones[0]?.start : phones[view.edge]?.end;
    context.fillStyle = ink.accent;
    if (time !== undefined) context.fillRect(scale.x(time) - 1.5, row.top, 3, row.height);
  }
  paintAsked(context, view);
}

function paintAsked(context: Context, { scene, lanes, asked }: View): void {
  if (!asked) return;
  const { controls } = scene.performance;
  const index = controls.names.indexOf(asked.control);
  const lane = lanes.find(({ control }) => control === index);
  if (!lane) return;
  const value = sample(controls, asked.time)[index];
  context.beginPath();
  context.arc(scene.scale.x(asked.time), paint.level(lane.row, value), 5.5, 0, 7);
  context.strokeStyle = scene.ink.text;
  context.lineWidth = 2;
  context.stroke();
}
