/** The line over time: waveform, words, phones whose edges can be dragged, curves and stages. */

import { sample, type Curves } from "../../shared/curves.ts";
import { clockTime } from "../../shared/format.ts";
import { readInk, type Ink } from "../../shared/ink.ts";
import { paint } from "../../shared/paint.ts";
import type { Player } from "../../shared/player.ts";
import type { Row } from "../../shared/rows.ts";
import { Scale } from "../../shared/scale.ts";
import { planeContext } from "../../shared/software.ts";
import { spanAt, type Span } from "../../shared/spans.ts";
import type { Peaks } from "../../shared/wav.ts";
import type { LineView, MotionView } from "../protocol.ts";
import type { StageName } from "./palette.ts";
import { paintChosen, paintStill, type View } from "./picture.ts";
import { LinePointer } from "./pointer.ts";
import { lanesOf, movedEdge, rowsOf, type Lane } from "./rows.ts";

/** Pixels that a second needs for its phones to be read. */
const READABLE = 130;
const INVITATION = "Type a line above and press Enter, or drop a recording on the page";

export interface Looks {
  hidden: Set<string>;
  /** The control whose stages are shown, and whom questions are about. */
  control: string;
  on: Set<StageName>;
  figures: boolean;
  apart: boolean;
}

export interface LineHooks {
  dragged(phone: number, time: number): void;
  why(control: string, time: number): void;
  phone(index: number): void;
  open(phone: number): void;
  moved(): void;
}

const NONE: Curves = { names: [], rate: 60, start: 0, values: new Float32Array() };

export class LineCanvas {
  readonly canvas: HTMLCanvasElement;
  scale = new Scale({ start: 0, end: 1 });
  chosen: number | null = null;
  asked: { time: number; control: string } | null = null;
  readonly hooks: LineHooks;
  readonly looks: Looks;
  player: Player | null = null;
  line: LineView | null = null;
  controls: Curves = NONE;
  phones: Span[] = [];
  words: Span[] = [];
  rows: Row[] = [];
  lanes: Lane[] = [];
  #motion: MotionView | null = null;
  #other: Curves | null = null;
  #peaks: Peaks | null = null;
  #pointer: LinePointer;
  #still = document.createElement("canvas");
  #stale = true;
  #ink: Ink;
  #listeners: (() => void)[] = [];

  constructor(canvas: HTMLCanvasElement, looks: Looks, hooks: LineHooks) {
    this.canvas = canvas;
    this.looks = looks;
    this.hooks = hooks;
    this.#ink = readInk(canvas);
    this.#pointer = new LinePointer(this);
  }

  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  /** Show another line from its start, or the same one anew. */
  showLine(line: LineView | null, player: Player | null): void {
    const other = line?.line !== this.line?.line;
    this.line = line;
    this.player = player;
    if (line && !this.dragging) {
      this.phones = line.phones;
      this.words = line.words;
    }
    if (!line) {
      [this.phones, this.words] = [[], []];
      this.controls = NONE;
      this.#motion = null;
    }
    if (player) {
      const { start, end, width } = this.scale;
      this.scale = new Scale(player.whole);
      this.scale.width = width;
      if (other) this.fit(width / READABLE);
      else {
        this.scale.zoom(end - start, 0);
        this.scale.centre((start + end) / 2);
      }
    }
    if (other) {
      this.chosen = null;
      this.asked = null;
    }
    this.refresh();
  }

  showMotion(
    controls: Curves | null,
    motion: MotionView | null,
    other: Curves | null = null,
  ): void {
    this.#other = other;
    this.controls = controls ?? NONE;
    this.#motion = motion;
    this.refresh();
  }

  showPeaks(peaks: Peaks | null): void {
    this.#peaks = peaks;
    this.refresh();
  }

  /** Whether a phone's edge is being dragged: then what is shown is newer than the server's. */
  get dragging(): boolean {
    return this.#pointer.dragging;
  }

  /** Draw everything anew with the next picture. */
  refresh(): void {
    this.#stale = true;
    this.touch();
  }

  /** Draw what moves with the next picture. */
  touch(): void {
    for (const listener of this.#listeners) listener();
  }

  resize(width: number, height: number): void {
    if (!width || !height) return;
    const first = this.scale.width === 1;
    const density = Math.min(devicePixelRatio, 3);
    for (const canvas of [this.canvas, this.#still]) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
    }
    this.scale.width = width;
    if (first) this.fit(width / READABLE);
    this.restyle();
  }

  restyle(): void {
    this.#ink = readInk(this.canvas);
    this.refresh();
  }

  fit(span = Number.POSITIVE_INFINITY): void {
    this.scale.zoom(span, this.scale.x(this.player?.time() ?? 0));
    this.turned();
  }

  zoom(factor: number): void {
    const x = this.scale.x(this.player?.time() ?? 0);
    const inside = x >= 0 && x <= this.scale.width;
    this.scale.zoom(this.scale.span * factor, inside ? x : this.scale.width / 2);
    this.turned();
  }

  /** Show a stretch of the line, with air on both sides. */
  reveal(start: number, end: number): void {
    if (start >= this.scale.start && end <= this.scale.end) return;
    if (end - start > this.scale.span) this.scale.zoom(2 * (end - start), 0);
    this.scale.centre((start + end) / 2);
    this.turned();
  }

  draw(): void {
    const context = planeContext(this.canvas);
    const { width, height } = this.canvas;
    const density = width / this.scale.width;
    const player = this.player;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = this.#ink.page;
    if (!player || !this.line) context.fillRect(0, 0, width, height);
    if (!player || !this.line) return this.#invite(context, density);
    const time = player.time();
    if (!this.#pointer.busy && this.scale.follow(time)) this.turned();
    this.rows = rowsOf(height / density, { overview: this.scale.zoomed, wave: !!this.#peaks });
    const chosen = this.controls.names.indexOf(this.looks.control);
    this.lanes = lanesOf(this.rows, this.#shown(), this.looks.apart, chosen);
    const view = this.#view(player);
    if (this.#stale) {
      const still = planeContext(this.#still);
      still.setTransform(density, 0, 0, density, 0, 0);
      still.fillStyle = this.#ink.page;
      still.fillRect(0, 0, this.scale.width, height / density);
      paintStill(still, view);
      this.#stale = false;
    }
    context.drawImage(this.#still, 0, 0);
    context.setTransform(density, 0, 0, density, 0, 0);
    paintChosen(context, view);
    paint.moving(context, view.scene, time, this.#pointer.hover);
    this.#describe(time);
  }

  /** What an empty line says. */
  #invite(context: CanvasRenderingContext2D, density: number): void {
    context.setTransform(density, 0, 0, density, 0, 0);
    context.fillStyle = this.#ink.muted;
    context.font = `14px ${this.#ink.font}`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    const height = this.canvas.height / density;
    context.fillText(INVITATION, this.scale.width / 2, height / 2);
  }

  /** What lies under the pointer, in words. */
  caption(): string {
    return this.#pointer.caption();
  }

  /** Where an instant of a control's curve is on the page. */
  placeOf(control: string, time: number): { x: number; y: number } | null {
    const index = this.controls.names.indexOf(control);
    const lane = this.lanes.find((each) => each.control === index);
    if (!lane) return null;
    const box = this.canvas.getBoundingClientRect();
    const value = sample(this.controls, time)[index];
    return { x: box.left + this.scale.x(time), y: box.top + paint.level(lane.row, value) };
  }

  /** Where the edge after a phone is on the page. */
  placeOfEdge(phone: number): { x: number; y: number } | null {
    const row = this.rows.find(({ name }) => name === "phones");
    const edge = phone < 0 ? this.phones[0]?.start : this.phones[phone]?.end;
    if (!row || edge === undefined) return null;
    const box = this.canvas.getBoundingClientRect();
    return { x: box.left + this.scale.x(edge), y: box.top + row.top + row.height / 2 };
  }

  /** The part that is shown has changed. */
  turned(): void {
    this.hooks.moved();
    this.refresh();
  }

  /** Show an edge of two phones elsewhere, before the server has moved it: seconds. */
  moveEdge(from: number, to: number): void {
    this.phones = movedEdge(this.phones, from, to);
    this.words = movedEdge(this.words, from, to);
    this.refresh();
  }

  choose(phone: number): void {
    this.chosen = phone < 0 ? null : phone;
    this.hooks.phone(phone);
    this.refresh();
  }

  #view(player: Player): View {
    const { names } = this.controls;
    const { looks, scale, rows, lanes } = this;
    const hidden = new Set(names.flatMap((name, at) => (looks.hidden.has(name) ? [at] : [])));
    const staged = looks.on.size > 0 && !looks.apart;
    const active = names.indexOf(looks.control);
    const highlighted = active >= 0 && (staged || !hidden.has(active)) ? active : null;
    const scene = {
      performance: { controls: this.controls, words: this.words, phones: this.phones },
      peaks: this.#peaks,
      rows,
      scale,
      shown: { hidden, highlighted, others: staged ? 0.2 : 0.8 },
      ink: this.#ink,
      range: player.looping ? player.range : null,
    };
    return {
      scene,
      looks,
      lanes,
      motion: this.#motion,
      other: this.#other,
      edits: this.line?.edits ?? [],
      chosen: this.chosen,
      edge: this.#pointer.edge,
      asked: this.asked,
    };
  }

  #shown(): number[] {
    const { hidden } = this.looks;
    return this.controls.names.flatMap((name, index) => (hidden.has(name) ? [] : [index]));
  }

  #describe(time: number): void {
    const word = this.words[spanAt(this.words, time)]?.label;
    const phone = this.phones[spanAt(this.phones, time)]?.label;
    const parts = [clockTime(time), word && `word ${word}`, phone && `phone ${phone}`];
    this.canvas.ariaValueText = parts.filter(Boolean).join(", ");
    this.canvas.ariaValueNow = time.toFixed(3);
    this.canvas.ariaValueMin = this.scale.whole.start.toFixed(3);
    this.canvas.ariaValueMax = this.scale.whole.end.toFixed(3);
  }
}
