/** The line over time: waveform, words, phones whose edges can be dragged, curves and stages. */

import { frameCount, sample, type Curves } from "../../shared/curves.ts";
import { clockTime, milliseconds } from "../../shared/format.ts";
import { readInk, type Ink } from "../../shared/ink.ts";
import { paint, type Scene } from "../../shared/paint.ts";
import type { Player } from "../../shared/player.ts";
import { hit, type Hit, type Row } from "../../shared/rows.ts";
import { Scale } from "../../shared/scale.ts";
import { planeContext } from "../../shared/software.ts";
import { middle, spanAt, type Span } from "../../shared/spans.ts";
import type { Peaks } from "../../shared/wav.ts";
import type { LineView, MotionView } from "../protocol.ts";
import type { StageName } from "./palette.ts";
import { edgeAt, lanesOf, movedEdge, roomOf, rowsOf, type Lane } from "./rows.ts";
import { paintResult, paintStages } from "./stages.ts";

const READABLE = 130;
const CURVE_REACH = 14;

export interface Looks {
  hidden: Set<string>;
  /** The control whose stages are shown, and whom questions are about. */
  control: string;
  on: Set<StageName>;
  figures: boolean;
  apart: boolean;
}

export interface LineHooks {
  dragged(phone: number, time: number, end: boolean): void;
  why(control: string, time: number): void;
  phone(index: number): void;
  open(phone: number): void;
  moved(): void;
}

interface Grip {
  mode: "scrub" | "range" | "overview" | "edge" | "curve";
  x: number;
  from: number;
  edge: number;
  at: number;
  span: Span | null;
  moved: boolean;
}

const NONE: Curves = { names: [], rate: 60, start: 0, values: new Float32Array() };

export class LineCanvas {
  readonly canvas: HTMLCanvasElement;
  scale = new Scale({ start: 0, end: 1 });
  chosen: number | null = null;
  asked: { time: number; control: string } | null = null;
  #hooks: LineHooks;
  #looks: Looks;
  #player: Player | null = null;
  #line: LineView | null = null;
  #controls: Curves = NONE;
  #motion: MotionView | null = null;
  #peaks: Peaks | null = null;
  #phones: Span[] = [];
  #words: Span[] = [];
  #rows: Row[] = [];
  #lanes: Lane[] = [];
  #hover: Hit | null = null;
  #edge: number | null = null;
  #grip: Grip | null = null;
  #still = document.createElement("canvas");
  #stale = true;
  #ink: Ink;
  #listeners: (() => void)[] = [];

  constructor(canvas: HTMLCanvasElement, looks: Looks, hooks: LineHooks) {
    this.canvas = canvas;
    this.#looks = looks;
    this.#hooks = hooks;
    this.#ink = readInk(canvas);
    canvas.addEventListener("pointerdown", (event) => this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", () => this.#release());
    canvas.addEventListener("pointercancel", () => (this.#grip = null));
    canvas.addEventListener("pointerleave", () => this.#point(null));
    canvas.addEventListener("dblclick", (event) => this.#double(event));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
  }

  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  /** Show another line from its start, or the same one anew. */
  showLine(line: LineView | null, player: Player | null): void {
    const other = line?.line !== this.#line?.line;
    this.#line = line;
    this.#player = player;
    if (line && this.#grip?.mode !== "edge") {
      this.#phones = line.phones;
      this.#words = line.words;
    }
    if (!line) {
      [this.#phones, this.#words] = [[], []];
      this.#controls = NONE;
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

  showMotion(controls: Curves | null, motion: MotionView | null): void {
    this.#controls = controls ?? NONE;
    this.#motion = motion;
    this.refresh();
  }

  showPeaks(peaks: Peaks | null): void {
    this.#peaks = peaks;
    this.refresh();
  }

  /** Whether a phone's edge is being dragged: then what is shown is newer than the server's. */
  get dragging(): boolean {
    return this.#grip?.mode === "edge";
  }

  /** Draw everything anew with the next picture. */
  refresh(): void {
    this.#stale = true;
    for (const listener of this.#listeners) listener();
  }

  resize(width: number, height: number): void {
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
    this.scale.zoom(span, this.scale.x(this.#player?.time() ?? 0));
    this.#turned();
  }

  zoom(factor: number): void {
    const x = this.scale.x(this.#player?.time() ?? 0);
    const inside = x >= 0 && x <= this.scale.width;
    this.scale.zoom(this.scale.span * factor, inside ? x : this.scale.width / 2);
    this.#turned();
  }

  /** Show a stretch of the line, with air on both sides. */
  reveal(start: number, end: number): void {
    if (start >= this.scale.start && end <= this.scale.end) return;
    if (end - start > this.scale.span) this.scale.zoom(2 * (end - start), 0);
    this.scale.centre((start + end) / 2);
    this.#turned();
  }

  draw(): void {
    const context = planeContext(this.canvas);
    const { width, height } = this.canvas;
    const density = width / this.scale.width;
    const player = this.#player;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    if (!player || !this.#line) return;
    const time = player.time();
    if (!this.#grip && this.scale.follow(time)) this.#turned();
    this.#rows = rowsOf(height / density, { overview: this.scale.zoomed, wave: !!this.#peaks });
    const chosen = this.#controls.names.indexOf(this.#looks.control);
    this.#lanes = lanesOf(this.#rows, this.#shown(), this.#looks.apart, chosen);
    const scene = this.#scene(player);
    if (this.#stale) {
      const still = planeContext(this.#still);
      still.setTransform(density, 0, 0, density, 0, 0);
      still.clearRect(0, 0, width, height);
      this.#paintStill(still, scene);
      this.#stale = false;
    }
    context.drawImage(this.#still, 0, 0);
    context.setTransform(density, 0, 0, density, 0, 0);
    this.#paintChosen(context);
    paint.moving(context, scene, time, this.#hover);
    this.#describe(time);
  }

  /** What lies under the pointer, in words. */
  caption(): string {
    const at = this.#hover;
    if (!at) return "";
    if (at.span)
      return `${at.span.label}  ${clockTime(at.span.start)}  ${milliseconds(at.span.end - at.span.start)}`;
    if (at.row !== "curves") return clockTime(at.time);
    const near = this.#controlAt(at.time, this.#pointerY);
    if (near === null) return clockTime(at.time);
    const value = sample(this.#controls, at.time)[near];
    return `${this.#controls.names[near]} ${value.toFixed(2)}  ${clockTime(at.time)}`;
  }

  get phones(): Span[] {
    return this.#phones;
  }

  /** Where an instant of a control's curve is on the page. */
  placeOf(control: string, time: number): { x: number; y: number } | null {
    const index = this.#controls.names.indexOf(control);
    const lane = this.#lanes.find((each) => each.control === index);
    if (!lane) return null;
    const box = this.canvas.getBoundingClientRect();
    const value = sample(this.#controls, time)[index];
    return { x: box.left + this.scale.x(time), y: box.top + paint.level(lane.row, value) };
  }

  /** Where the edge after a phone is on the page. */
  placeOfEdge(phone: number): { x: number; y: number } | null {
    const row = this.#rows.find(({ name }) => name === "phones");
    const edge = phone < 0 ? this.#phones[0]?.start : this.#phones[phone]?.end;
    if (!row || edge === undefined) return null;
    const box = this.canvas.getBoundingClientRect();
    return { x: box.left + this.scale.x(edge), y: box.top + row.top + row.height / 2 };
  }

  #pointerY = 0;

  #shown(): number[] {
    const { hidden } = this.#looks;
    return this.#controls.names.flatMap((name, index) => (hidden.has(name) ? [] : [index]));
  }

  #scene(player: Player): Scene {
    const names = this.#controls.names;
    const hidden = new Set(names.flatMap((name, at) => (this.#looks.hidden.has(name) ? [at] : [])));
    const staged = this.#looks.on.size > 0 && !this.#looks.apart;
    const active = names.indexOf(this.#looks.control);
    return {
      performance: { controls: this.#controls, words: this.#words, phones: this.#phones },
      peaks: this.#peaks,
      rows: this.#rows,
      scale: this.scale,
      shown: {
        hidden,
        highlighted: active >= 0 && (staged || !hidden.has(active)) ? active : null,
        others: staged ? 0.2 : 0.8,
      },
      ink: this.#ink,
      range: player.looping ? player.range : null,
    };
  }

  #paintStill(context: CanvasRenderingContext2D, scene: Scene): void {
    for (const row of this.#rows) {
      if (row.name === "curves" && (this.#looks.apart || this.#looks.on.size))
        this.#paintCurves(context, scene, row);
      else paint.row(context, scene, row);
    }
    this.#paintEdits(context);
  }

  #paintCurves(context: CanvasRenderingContext2D, scene: Scene, row: Row): void {
    const { apart, on, control, figures } = this.#looks;
    const own = this.#lanes.find(({ control: at }) => this.#controls.names[at] === control);
    if (!apart)
      for (const share of [0, 0.5, 1]) {
        const inner = paint.inside(row);
        paint.rule(context, this.scale.width, inner.top + share * inner.height, this.#ink.line);
      }
    for (const lane of this.#lanes) {
      if (apart) this.#paintLane(context, lane);
      if (lane !== own || !on.size) paint.curve(context, scene, lane.row, lane.control);
    }
    if (!own || !this.#motion || !on.size) return;
    const { dark } = this.#ink;
    const { scale } = this;
    const motion = this.#motion;
    const { row: lane } = own;
    paintStages(context, { motion, control, on, dark, figures, scale, row: lane });
    paintResult(context, this.#controls, own, scale, this.#ink.text);
  }

  #paintLane(context: CanvasRenderingContext2D, { control, row }: Lane): void {
    const name = this.#controls.names[control];
    if (name === this.#looks.control) {
      context.fillStyle = this.#ink.raised;
      context.globalAlpha = 0.6;
      context.fillRect(0, row.top - 2, this.scale.width, row.height + 4);
      context.globalAlpha = 1;
    }
    paint.rule(context, this.scale.width, row.top + row.height + 2, this.#ink.line);
    if (row.height < 13) return;
    context.font = `10.5px ${this.#ink.font}`;
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillStyle = this.#ink.muted;
    context.fillText(name, 4, row.top);
  }

  /** Phones that are corrected in this line. */
  #paintEdits(context: CanvasRenderingContext2D): void {
    const row = this.#rows.find(({ name }) => name === "phones");
    if (!row || !this.#line) return;
    context.fillStyle = this.#ink.accent;
    for (const { lost, start, end } of this.#line.edits)
      if (!lost)
        context.fillRect(
          this.scale.x(start) + 2,
          row.top + row.height - 4,
          Math.max(this.scale.x(end) - this.scale.x(start) - 4, 2),
          2.5,
        );
  }

  #paintChosen(context: CanvasRenderingContext2D): void {
    const row = this.#rows.find(({ name }) => name === "phones");
    const span = this.chosen === null ? null : this.#phones[this.chosen];
    if (row && span) {
      context.strokeStyle = this.#ink.accent;
      context.lineWidth = 2;
      const x = this.scale.x(span.start);
      context.strokeRect(x + 1, row.top + 1.5, this.scale.x(span.end) - x - 2, row.height - 3);
    }
    if (row && this.#edge !== null && !this.#grip) this.#paintEdge(context, row, this.#edge);
    if (!this.asked) return;
    const place = this.placeOf(this.asked.control, this.asked.time);
    if (!place) return;
    const box = this.canvas.getBoundingClientRect();
    context.beginPath();
    context.arc(place.x - box.left, place.y - box.top, 5.5, 0, 7);
    context.strokeStyle = this.#ink.text;
    context.lineWidth = 2;
    context.stroke();
  }

  #paintEdge(context: CanvasRenderingContext2D, row: Row, edge: number): void {
    const time = edge < 0 ? this.#phones[0].start : this.#phones[edge].end;
    context.fillStyle = this.#ink.accent;
    context.fillRect(this.scale.x(time) - 1.5, row.top, 3, row.height);
  }

  #describe(time: number): void {
    const word = this.#words[spanAt(this.#words, time)]?.label;
    const phone = this.#phones[spanAt(this.#phones, time)]?.label;
    const parts = [clockTime(time), word && `word ${word}`, phone && `phone ${phone}`];
    this.canvas.ariaValueText = parts.filter(Boolean).join(", ");
    this.canvas.ariaValueNow = time.toFixed(3);
    this.canvas.ariaValueMin = this.scale.whole.start.toFixed(3);
    this.canvas.ariaValueMax = this.scale.whole.end.toFixed(3);
  }

  #hit(event: MouseEvent): Hit {
    const box = this.canvas.getBoundingClientRect();
    this.#pointerY = event.clientY - box.top;
    const tiers = { words: this.#words, phones: this.#phones };
    return hit(event.clientX - box.left, this.#pointerY, this.#rows, this.scale, tiers);
  }

  #edgeUnder(event: MouseEvent, at: Hit): number | null {
    if (at.row !== "phones") return null;
    const box = this.canvas.getBoundingClientRect();
    return edgeAt(this.#phones, this.scale, event.clientX - box.left);
  }

  #press(event: PointerEvent): void {
    if (event.button !== 0 || !this.#player || !this.#line) return;
    const at = this.#hit(event);
    this.canvas.setPointerCapture(event.pointerId);
    const edge = this.#edgeUnder(event, at);
    const mode = event.shiftKey
      ? "range"
      : edge !== null
        ? "edge"
        : at.row === "overview"
          ? "overview"
          : at.row === "curves"
            ? "curve"
            : "scrub";
    this.#grip = {
      mode,
      x: event.clientX,
      from: at.time,
      edge: edge ?? 0,
      at: edge === null ? 0 : edge < 0 ? this.#phones[0].start : this.#phones[edge].end,
      span: at.span,
      moved: false,
    };
    if (mode === "range" || mode === "edge") return;
    const time = at.span ? (at.row === "words" ? at.span.start : middle(at.span)) : at.time;
    this.#player.seek(time, true);
    if (at.row === "phones") this.#choose(at.span);
    if (mode === "overview") this.#centre(time);
  }

  #choose(span: Span | null): void {
    this.chosen = span ? this.#phones.indexOf(span) : null;
    this.#hooks.phone(this.chosen ?? -1);
    this.refresh();
  }

  /** Choose a phone by its number, as with the pointer. */
  choosePhone(index: number): void {
    const span = this.#phones[index];
    if (span) this.#choose(span);
  }

  #move(event: PointerEvent): void {
    const at = this.#hit(event);
    const grip = this.#grip;
    this.#edge = grip ? null : this.#edgeUnder(event, at);
    this.#point(at);
    if (!grip || !this.#player) return;
    if (!grip.moved && Math.abs(event.clientX - grip.x) < 4) return;
    grip.moved = true;
    grip.span = null;
    if (grip.mode === "edge") this.#dragEdge(grip, at.time);
    else if (grip.mode === "range") this.#player.setRange(ordered(grip.from, at.time));
    else this.#player.seek(at.time, true);
    if (grip.mode === "overview") this.#centre(at.time);
    if (grip.mode === "range") this.refresh();
  }

  #dragEdge(grip: Grip, to: number): void {
    const [least, most] = roomOf(this.#phones, grip.edge);
    const time = Math.round(Math.min(Math.max(to, least), most) * 1000) / 1000;
    this.#phones = movedEdge(this.#phones, grip.at, time);
    this.#words = movedEdge(this.#words, grip.at, time);
    grip.at = time;
    this.#hooks.dragged(grip.edge, time, false);
    this.refresh();
  }

  #release(): void {
    const grip = this.#grip;
    this.#grip = null;
    if (!grip) return;
    if (grip.mode === "edge" && grip.moved) this.#hooks.dragged(grip.edge, grip.at, true);
    if (grip.mode === "curve" && !grip.moved) {
      const near = this.#controlAt(grip.from, this.#pointerY);
      if (near !== null) this.#hooks.why(this.#controls.names[near], grip.from);
    }
    this.refresh();
  }

  /** The control whose curve passes nearest to a height at a time. */
  #controlAt(time: number, y: number): number | null {
    if (!frameCount(this.#controls)) return null;
    const values = sample(this.#controls, time);
    let best: number | null = null;
    let least = CURVE_REACH;
    for (const { control, row } of this.#lanes) {
      const inside = this.#looks.apart && y >= row.top - 3 && y <= row.top + row.height + 3;
      const far = inside ? 0 : Math.abs(paint.level(row, values[control]) - y);
      // Where several lie on zero, that which is being looked at is meant.
      const counted = far - (this.#controls.names[control] === this.#looks.control ? 3 : 0);
      if (counted < least) [best, least] = [control, counted];
    }
    return best;
  }

  #centre(time: number): void {
    this.scale.centre(time);
    this.#turned();
  }

  #turned(): void {
    this.#hooks.moved();
    this.refresh();
  }

  /** A phone's pair opens in the editor; a word is looped. */
  #double(event: MouseEvent): void {
    const { span, row } = this.#hit(event);
    if (row === "phones" && span) return this.#hooks.open(this.#phones.indexOf(span));
    if (row !== "words") return;
    this.#player?.setRange(span && { start: span.start, end: span.end });
    this.refresh();
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 24 : 1;
    const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (Math.abs(sideways) > Math.abs(event.deltaY) || event.shiftKey) {
      this.scale.pan(sideways * unit);
    } else {
      const x = event.clientX - this.canvas.getBoundingClientRect().left;
      this.scale.zoom(this.scale.span * Math.exp(event.deltaY * unit * 0.0015), x);
    }
    this.#turned();
  }

  #point(at: Hit | null): void {
    this.#hover = at;
    if (!at) this.#edge = null;
    const curve = at?.row === "curves" && this.#controlAt(at.time, this.#pointerY) !== null;
    this.canvas.style.cursor =
      this.#edge !== null || this.#grip?.mode === "edge"
        ? "ew-resize"
        : at?.span || curve
          ? "pointer"
          : "";
    for (const listener of this.#listeners) listener();
  }
}

function ordered(a: number, b: number): { start: number; end: number } {
  return { start: Math.min(a, b), end: Math.max(a, b) };
}
