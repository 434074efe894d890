/** What the pointer does in the line: scrub, loop, drag the edges of phones, ask why, zoom. */

import { frameCount, sample } from "../../shared/curves.ts";
import { clockTime, milliseconds } from "../../shared/format.ts";
import { paint } from "../../shared/paint.ts";
import { hit, type Hit } from "../../shared/rows.ts";
import { middle, type Span } from "../../shared/spans.ts";
import type { LineCanvas } from "./canvas.ts";
import { edgeAt, roomOf } from "./rows.ts";

/** Pixels around a curve that mean it. */
const REACH = 14;
/** Pixels that a hand moves without meaning to drag. */
const STILL = 4;

type Mode = "scrub" | "range" | "overview" | "edge" | "curve";

interface Grip {
  mode: Mode;
  x: number;
  from: number;
  edge: number;
  /** Where the edge is now, seconds. */
  at: number;
  moved: boolean;
}

export class LinePointer {
  hover: Hit | null = null;
  #canvas: LineCanvas;
  #grip: Grip | null = null;
  #edge: number | null = null;
  #y = 0;

  constructor(canvas: LineCanvas) {
    this.#canvas = canvas;
    const element = canvas.canvas;
    element.addEventListener("pointerdown", (event) => this.#press(event));
    element.addEventListener("pointermove", (event) => this.#move(event));
    element.addEventListener("pointerup", () => this.#release());
    element.addEventListener("pointercancel", () => (this.#grip = null));
    element.addEventListener("pointerleave", () => this.#point(null));
    element.addEventListener("dblclick", (event) => this.#double(event));
    element.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
  }

  /** Whether anything is held: then the page does not turn by itself. */
  get busy(): boolean {
    return this.#grip !== null;
  }

  get dragging(): boolean {
    return this.#grip?.mode === "edge";
  }

  /** The edge that a press would take hold of. */
  get edge(): number | null {
    return this.#grip ? null : this.#edge;
  }

  caption(): string {
    const at = this.hover;
    if (!at) return "";
    if (at.span)
      return `${at.span.label}  ${clockTime(at.span.start)}  ${milliseconds(at.span.end - at.span.start)}`;
    const near = at.row === "curves" ? this.#controlAt(at.time) : null;
    if (near === null) return clockTime(at.time);
    const { controls } = this.#canvas;
    const value = sample(controls, at.time)[near];
    return `${controls.names[near]} ${value.toFixed(2)}  ${clockTime(at.time)}`;
  }

  #hit(event: MouseEvent): Hit {
    const { canvas, words, phones, rows, scale } = this.#canvas;
    const box = canvas.getBoundingClientRect();
    this.#y = event.clientY - box.top;
    return hit(event.clientX - box.left, this.#y, rows, scale, { words, phones });
  }

  #edgeUnder(event: MouseEvent, at: Hit): number | null {
    if (at.row !== "phones") return null;
    const { canvas, phones, scale } = this.#canvas;
    return edgeAt(phones, scale, event.clientX - canvas.getBoundingClientRect().left);
  }

  #press(event: PointerEvent): void {
    const canvas = this.#canvas;
    const { player, phones } = canvas;
    if (event.button !== 0 || !player || !canvas.line) return;
    const at = this.#hit(event);
    canvas.canvas.setPointerCapture(event.pointerId);
    const edge = this.#edgeUnder(event, at);
    const mode = event.shiftKey ? "range" : edge !== null ? "edge" : modeOf(at);
    const time = edge === null ? 0 : edge < 0 ? phones[0].start : phones[edge].end;
    this.#grip = { mode, x: event.clientX, from: at.time, edge: edge ?? 0, at: time, moved: false };
    if (mode === "range" || mode === "edge") return;
    const to = at.span ? (at.row === "words" ? at.span.start : middle(at.span)) : at.time;
    player.seek(to, true);
    if (at.row === "phones") canvas.choose(at.span ? phones.indexOf(at.span) : -1);
    if (mode === "overview") this.#centre(to);
  }

  #move(event: PointerEvent): void {
    const at = this.#hit(event);
    const grip = this.#grip;
    this.#edge = grip ? null : this.#edgeUnder(event, at);
    this.#point(at);
    const { player } = this.#canvas;
    if (!grip || !player) return;
    if (!grip.moved && Math.abs(event.clientX - grip.x) < STILL) return;
    grip.moved = true;
    if (grip.mode === "edge") this.#dragEdge(grip, at.time);
    else if (grip.mode === "range") {
      player.setRange(ordered(grip.from, at.time));
      this.#canvas.refresh();
    } else player.seek(at.time, true);
    if (grip.mode === "overview") this.#centre(at.time);
  }

  #dragEdge(grip: Grip, to: number): void {
    const canvas = this.#canvas;
    const [least, most] = roomOf(canvas.phones, grip.edge);
    const time = Math.round(Math.min(Math.max(to, least), most) * 1000) / 1000;
    canvas.moveEdge(grip.at, time);
    grip.at = time;
    canvas.hooks.dragged(grip.edge, time);
  }

  #release(): void {
    const grip = this.#grip;
    this.#grip = null;
    if (!grip) return;
    const { hooks, controls } = this.#canvas;
    if (grip.mode === "edge" && grip.moved) hooks.dragged(grip.edge, grip.at);
    if (grip.mode === "curve" && !grip.moved) {
      const near = this.#controlAt(grip.from);
      if (near !== null) hooks.why(controls.names[near], grip.from);
    }
    this.#canvas.refresh();
  }

  /** The control whose curve passes nearest to the pointer. */
  #controlAt(time: number): number | null {
    const { controls, lanes, looks } = this.#canvas;
    if (!frameCount(controls)) return null;
    const values = sample(controls, time);
    let best: number | null = null;
    let least = REACH;
    for (const { control, row } of lanes) {
      const inside = looks.apart && this.#y >= row.top - 3 && this.#y <= row.top + row.height + 3;
      const far = inside ? 0 : Math.abs(paint.level(row, values[control]) - this.#y);
      // Where several lie on zero, that which is being looked at is meant.
      const counted = far - (controls.names[control] === looks.control ? 3 : 0);
      if (counted < least) [best, least] = [control, counted];
    }
    return best;
  }

  #centre(time: number): void {
    this.#canvas.scale.centre(time);
    this.#canvas.turned();
  }

  /** A phone's pair opens in the editor; a word is looped. */
  #double(event: MouseEvent): void {
    const canvas = this.#canvas;
    const { span, row } = this.#hit(event);
    if (row === "phones" && span) return canvas.hooks.open(canvas.phones.indexOf(span));
    if (row !== "words") return;
    canvas.player?.setRange(rangeOf(span));
    canvas.refresh();
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const { scale, canvas } = this.#canvas;
    const unit = event.deltaMode === 1 ? 24 : 1;
    const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (Math.abs(sideways) > Math.abs(event.deltaY) || event.shiftKey) {
      scale.pan(sideways * unit);
    } else {
      const x = event.clientX - canvas.getBoundingClientRect().left;
      scale.zoom(scale.span * Math.exp(event.deltaY * unit * 0.0015), x);
    }
    this.#canvas.turned();
  }

  #point(at: Hit | null): void {
    this.hover = at;
    if (!at) this.#edge = null;
    const curve = at?.row === "curves" && this.#controlAt(at.time) !== null;
    const edge = this.#edge !== null || this.dragging;
    this.#canvas.canvas.style.cursor = edge ? "ew-resize" : at?.span || curve ? "pointer" : "";
    this.#canvas.touch();
  }
}

function modeOf(at: Hit): Mode {
  if (at.row === "overview") return "overview";
  return at.row === "curves" ? "curve" : "scrub";
}

function rangeOf(span: Span | null): { start: number; end: number } | null {
  return span && { start: span.start, end: span.end };
}

function ordered(a: number, b: number): { start: number; end: number } {
  return { start: Math.min(a, b), end: Math.max(a, b) };
}
