/** The timeline: waveform, words, phones and curves over one axis; drag to scrub. */

import type { Range } from "../shared/clock.ts";
import type { Performance } from "./document.ts";
import { clockTime, milliseconds } from "../shared/format.ts";
import { readInk, type Ink } from "../shared/ink.ts";
import { paint, type Shown } from "../shared/paint.ts";
import type { Player } from "../shared/player.ts";
import { hit, layOut, type Hit, type Row } from "../shared/rows.ts";
import { Scale } from "../shared/scale.ts";
import { middle, spanAt, type Span } from "../shared/spans.ts";
import type { Peaks } from "../shared/wav.ts";

/** Pixels that a second needs for its phones to be read. */
const READABLE = 130;

export class Timeline {
  readonly scale: Scale;
  hover: Hit | null = null;
  #canvas: HTMLCanvasElement;
  #still = document.createElement("canvas");
  #performance: Performance;
  #player: Player;
  #peaks: Peaks | null;
  #shown: Shown;
  #rows: Row[] = [];
  #ink: Ink;
  #stale = true;
  #drag: {
    mode: "scrub" | "range" | "overview";
    from: number;
    x: number;
    span: Span | null;
  } | null = null;
  #listeners: (() => void)[] = [];

  constructor(
    canvas: HTMLCanvasElement,
    performance: Performance,
    player: Player,
    peaks: Peaks | null,
    shown: Shown,
  ) {
    this.#canvas = canvas;
    this.#performance = performance;
    this.#player = player;
    this.#peaks = peaks;
    this.#shown = shown;
    this.scale = new Scale(player.whole);
    this.#ink = readInk(canvas);
    canvas.addEventListener("pointerdown", (event) => this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", () => (this.#drag = null));
    canvas.addEventListener("pointercancel", () => (this.#drag = null));
    canvas.addEventListener("pointerleave", () => this.#point(null));
    canvas.addEventListener("dblclick", (event) => this.#choose(event));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
  }

  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  /** Draw everything anew at the next picture: size, theme, zoom or curves have changed. */
  refresh(): void {
    this.#stale = true;
    for (const listener of this.#listeners) listener();
  }

  resize(width: number, height: number): void {
    const first = this.scale.width === 1;
    const density = Math.min(devicePixelRatio, 3);
    for (const canvas of [this.#canvas, this.#still]) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
    }
    this.scale.width = width;
    if (first) this.fit(width / READABLE);
    this.#ink = readInk(this.#canvas);
    this.refresh();
  }

  restyle(): void {
    this.#ink = readInk(this.#canvas);
    this.refresh();
  }

  /** Show at most `span` seconds around the playhead; all of them by default. */
  fit(span = Number.POSITIVE_INFINITY): void {
    this.scale.zoom(span, this.scale.x(this.#player.time()));
    this.refresh();
  }

  zoom(factor: number): void {
    const x = this.scale.x(this.#player.time());
    const inside = x >= 0 && x <= this.scale.width;
    this.scale.zoom(this.scale.span * factor, inside ? x : this.scale.width / 2);
    this.refresh();
  }

  draw(): void {
    const time = this.#player.time();
    if (!this.#drag && this.scale.follow(time)) this.#stale = true;
    const { width, height } = this.#canvas;
    const density = width / this.scale.width;
    const has = { overview: this.scale.zoomed, wave: this.#peaks !== null };
    this.#rows = layOut(height / density, has);
    const context = this.#canvas.getContext("2d") as CanvasRenderingContext2D;
    const scene = {
      performance: this.#performance,
      peaks: this.#peaks,
      rows: this.#rows,
      scale: this.scale,
      shown: this.#shown,
      ink: this.#ink,
      range: this.#player.looping ? this.#player.range : null,
    };
    if (this.#stale) {
      const still = this.#still.getContext("2d") as CanvasRenderingContext2D;
      still.setTransform(density, 0, 0, density, 0, 0);
      still.clearRect(0, 0, width, height);
      paint.still(still, scene);
      this.#stale = false;
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.drawImage(this.#still, 0, 0);
    context.setTransform(density, 0, 0, density, 0, 0);
    paint.moving(context, scene, time, this.hover);
    this.#describe(time);
  }

  /** What lies under the pointer, in words. */
  caption(): string {
    const span = this.hover?.span;
    if (!span) return this.hover ? clockTime(this.hover.time) : "";
    return `${span.label}  ${clockTime(span.start)}  ${milliseconds(span.end - span.start)}`;
  }

  #describe(time: number): void {
    const { words, phones } = this.#performance;
    const word = words[spanAt(words, time)]?.label;
    const phone = phones[spanAt(phones, time)]?.label;
    const parts = [clockTime(time), word && `word ${word}`, phone && `phone ${phone}`];
    this.#canvas.ariaValueText = parts.filter(Boolean).join(", ");
    this.#canvas.ariaValueNow = time.toFixed(3);
  }

  #hit(event: MouseEvent): Hit {
    const box = this.#canvas.getBoundingClientRect();
    return hit(
      event.clientX - box.left,
      event.clientY - box.top,
      this.#rows,
      this.scale,
      this.#performance,
    );
  }

  #press(event: PointerEvent): void {
    if (event.button !== 0) return;
    const at = this.#hit(event);
    this.#canvas.setPointerCapture(event.pointerId);
    const mode = event.shiftKey ? "range" : at.row === "overview" ? "overview" : "scrub";
    this.#drag = { mode, from: at.time, x: event.clientX, span: at.span };
    if (mode === "range") return;
    const word = at.row === "words";
    const time = at.span ? (word ? at.span.start : middle(at.span)) : at.time;
    this.#player.seek(time, true);
    if (mode === "overview") this.#centre(time);
  }

  #move(event: PointerEvent): void {
    const at = this.#hit(event);
    this.#point(at);
    const drag = this.#drag;
    if (!drag) return;
    if (drag.span && Math.abs(event.clientX - drag.x) < 4) return;
    drag.span = null;
    if (drag.mode === "range") this.#player.setRange(ordered(drag.from, at.time));
    else this.#player.seek(at.time, true);
    if (drag.mode === "overview") this.#centre(at.time);
    if (drag.mode === "range") this.refresh();
  }

  #centre(time: number): void {
    this.scale.centre(time);
    this.refresh();
  }

  /** Repeat the word or the phone under the pointer. */
  #choose(event: MouseEvent): void {
    const { span } = this.#hit(event);
    this.#player.setRange(span && { start: span.start, end: span.end });
    this.refresh();
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 24 : 1;
    const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (Math.abs(sideways) > Math.abs(event.deltaY) || event.shiftKey) {
      this.scale.pan(sideways * unit);
    } else {
      const x = event.clientX - this.#canvas.getBoundingClientRect().left;
      this.scale.zoom(this.scale.span * Math.exp(event.deltaY * unit * 0.0015), x);
    }
    this.refresh();
  }

  #point(at: Hit | null): void {
    this.hover = at;
    this.#canvas.style.cursor = at?.span ? "pointer" : "";
    for (const listener of this.#listeners) listener();
  }
}

function ordered(a: number, b: number): Range {
  return { start: Math.min(a, b), end: Math.max(a, b) };
}
