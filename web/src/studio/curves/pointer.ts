/** What the pointer does in the curve editor: choose, drag, scale, add, zoom. */

import type { CurveEditor } from "./editor.ts";
import { frameOf, handleAt, stretch, type Frame, type Handle } from "./handles.ts";
import * as act from "./keys.ts";
import type { Curves, Key } from "./keys.ts";
import type { Drawing } from "./paint.ts";

const REACH = 9;
const LINE_REACH = 6;
const PULL = 7;
/** Pixels that a hand moves without meaning to drag. */
const STILL = 3;

type Place = { name: string; index: number };

interface Grip {
  mode: "keys" | "box" | "boundary" | "pan" | "scale";
  x: number;
  y: number;
  curves: Curves;
  chosen: Map<string, Set<number>>;
  /** The key under the pointer: it is what snaps. */
  lead: Key | null;
  frame: Frame | null;
  handle: Handle | null;
  merge: string;
  moved: boolean;
}

const clamp = (value: number, low: number, high: number) => Math.min(Math.max(value, low), high);
const hundredths = (value: number) => Math.round(value * 100) / 100;

export class CurvePointer {
  /** Where the pointer is; null when it is elsewhere. */
  at: { x: number; y: number } | null = null;
  #editor: CurveEditor;
  #grip: Grip | null = null;
  #hovered: Place | null = null;
  #handle: Handle | null = null;
  #pulled: Drawing["pulled"] = { time: null, value: null };
  #hot = false;

  constructor(editor: CurveEditor) {
    this.#editor = editor;
    const { canvas } = editor;
    canvas.addEventListener("pointerdown", (event) => this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", () => this.#release());
    canvas.addEventListener("pointercancel", () => this.cancel());
    canvas.addEventListener("pointerleave", () => this.#leave());
    canvas.addEventListener("dblclick", (event) => this.#double(event));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  /** Whether curves are being changed by it. */
  get changing(): boolean {
    return this.#grip !== null && this.#grip.mode !== "pan";
  }

  forget(): void {
    this.#grip = null;
    this.#hovered = null;
    this.#handle = null;
  }

  /** Give up what is being dragged: the curves are as they were. */
  cancel(): void {
    const grip = this.#grip;
    this.#grip = null;
    this.#pulled = { time: null, value: null };
    if (grip?.moved && (grip.mode === "keys" || grip.mode === "scale"))
      this.#editor.take(grip.curves, grip.merge);
    this.#editor.refresh();
  }

  /** What is drawn because of it. */
  marks() {
    const { curves, chosen } = this.#editor;
    const drags = this.#grip?.moved && (this.#grip.mode === "keys" || this.#grip.mode === "scale");
    return {
      before: drags && this.#grip ? this.#grip.curves : null,
      hovered: this.#hovered,
      boundaryHot: this.#hot || this.#grip?.mode === "boundary",
      box: this.#box(),
      pulled: this.#pulled,
      frame: this.#grip?.mode === "box" ? null : frameOf(curves, chosen),
      handle: this.#grip?.handle ?? this.#handle,
    };
  }

  /** What the pointer or the dragged key says, in words. */
  readout(): string {
    const { active, chosen, curves, count, plot } = this.#editor;
    const format = (value: number) => value.toFixed(3).replace(/0$/, "");
    if (this.#grip?.mode === "keys" && count === 1) {
      const [index] = chosen.get(active) ?? [0];
      const key = curves[active]?.[index];
      if (key) return `t ${format(key[0])}   w ${format(key[1])}`;
    }
    if (count > 1) return `${count} keys`;
    if (!this.at) return "";
    const value = clamp(plot.value(this.at.y), 0, 1);
    return `t ${format(plot.time(this.at.x))}   w ${format(value)}`;
  }

  #place(event: MouseEvent): { x: number; y: number } {
    const box = this.#editor.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #keyAt(x: number, y: number): Place | null {
    const { curves, plot, active } = this.#editor;
    let best: Place | null = null;
    let least = REACH;
    for (const [name, keys] of Object.entries(curves))
      keys.forEach(([time, value], index) => {
        const far = Math.hypot(plot.x(time) - x, plot.y(value) - y);
        // Of keys on each other that of the active curve is meant.
        const counted = name === active ? far - 3 : far;
        if (counted < least) [best, least] = [{ name, index }, counted];
      });
    return best;
  }

  #curveAt(x: number, y: number): string | null {
    const { curves, plot } = this.#editor;
    let best: string | null = null;
    let least = LINE_REACH;
    for (const [name, keys] of Object.entries(curves)) {
      const value = act.valueAt(keys, plot.time(x));
      const far = Math.abs(plot.y(value) - y);
      if (value > 0 && far < least) [best, least] = [name, far];
    }
    return best;
  }

  #onBoundary(x: number, y: number): boolean {
    const { subject, plot } = this.#editor;
    const boundary = subject?.boundary ?? null;
    return boundary !== null && Math.abs(plot.x(boundary) - x) < 8 && y > plot.bottom + 4;
  }

  #handleAt(x: number, y: number): Handle | null {
    const { curves, chosen, plot } = this.#editor;
    return handleAt(frameOf(curves, chosen), plot, x, y);
  }

  #press(event: PointerEvent): void {
    const editor = this.#editor;
    if (!editor.subject) return;
    const { x, y } = this.#place(event);
    editor.canvas.focus({ preventScroll: true });
    editor.canvas.setPointerCapture(event.pointerId);
    const grip = this.#hold(x, y);
    this.#grip = grip;
    const handle = this.#handleAt(x, y);
    const key = this.#keyAt(x, y);
    if (event.button === 1 || event.button === 2) grip.mode = "pan";
    else if (this.#onBoundary(x, y)) grip.mode = "boundary";
    else if (key) this.#grasp(grip, key, event.shiftKey);
    else if (handle) Object.assign(grip, { mode: "scale", handle });
    else if (event.ctrlKey || event.metaKey) this.#addAt(x, y);
    else if (!event.shiftKey) {
      const curve = this.#curveAt(x, y);
      if (curve) editor.activate(curve);
      else editor.chooseNone();
    }
    event.preventDefault();
    editor.refresh();
  }

  #hold(x: number, y: number): Grip {
    const { curves, chosen, hooks } = this.#editor;
    return {
      mode: "box",
      x,
      y,
      curves,
      chosen: chosen as Map<string, Set<number>>,
      lead: null,
      frame: frameOf(curves, chosen),
      handle: null,
      merge: hooks.drag(),
      moved: false,
    };
  }

  #grasp(grip: Grip, { name, index }: Place, extend: boolean): void {
    const editor = this.#editor;
    const picked = editor.chosen.get(name)?.has(index) ?? false;
    let chosen = editor.chosen as Map<string, Set<number>>;
    if (extend) {
      const own = new Set(chosen.get(name));
      if (picked) own.delete(index);
      else own.add(index);
      chosen = new Map(chosen);
      if (own.size) chosen.set(name, own);
      else chosen.delete(name);
    } else if (!picked) chosen = new Map([[name, new Set([index])]]);
    grip.mode = "keys";
    grip.chosen = chosen;
    grip.lead = editor.curves[name][index];
    editor.pick(chosen, name);
    editor.tell();
  }

  #move(event: PointerEvent): void {
    const at = this.#place(event);
    this.at = at;
    const grip = this.#grip;
    if (!grip) return this.#hover(at.x, at.y);
    if (!grip.moved && Math.hypot(at.x - grip.x, at.y - grip.y) < STILL) return;
    grip.moved = true;
    if (grip.mode === "pan") {
      this.#editor.plot.pan(grip.x - at.x);
      grip.x = at.x;
    } else if (grip.mode === "boundary") this.#dragBoundary(at.x, event, grip.merge);
    else if (grip.mode === "keys") this.#dragKeys(grip, at.x, at.y, event);
    else if (grip.mode === "scale") this.#scale(grip, at.x, at.y, event);
    else this.#dragBox(grip, at.x, at.y, event.shiftKey);
    this.#editor.refresh();
  }

  #pulls(event: PointerEvent): boolean {
    return this.#editor.snapping !== event.altKey;
  }

  #places(): number[] {
    const boundary = this.#editor.subject?.boundary;
    return [0, 1, ...(boundary ? [boundary] : [])];
  }

  #dragBoundary(x: number, event: PointerEvent, merge: string): void {
    const { plot } = this.#editor;
    const free = plot.time(x);
    const to = this.#pulls(event) ? act.snap(free, [0.5], PULL * plot.perPixel.time) : free;
    this.#editor.moveBoundary(hundredths(clamp(to, 0.01, 0.99)), merge);
  }

  #dragKeys(grip: Grip, x: number, y: number, event: PointerEvent): void {
    const { plot, domain } = this.#editor;
    const slow = event.shiftKey ? 0.25 : 1;
    const { time: perX, value: perY } = plot.perPixel;
    let byTime = (x - grip.x) * perX * slow;
    let byValue = (grip.y - y) * perY * slow;
    if (event.ctrlKey || event.metaKey) {
      if (Math.abs(x - grip.x) > Math.abs(y - grip.y)) byValue = 0;
      else byTime = 0;
    }
    this.#pulled = { time: null, value: null };
    if (grip.lead && this.#pulls(event)) {
      const [time, value] = grip.lead;
      byTime = this.#pull("time", time + byTime, this.#places(), PULL * perX * slow) - time;
      byValue = this.#pull("value", value + byValue, [0, 1], PULL * perY * slow) - value;
    }
    const moved = act.move(grip.curves, grip.chosen, domain, byTime, byValue);
    this.#editor.take(moved, grip.merge);
  }

  /** A place that pulls, which is then drawn, or else whole hundredths. */
  #pull(axis: "time" | "value", free: number, places: number[], within: number): number {
    const to = act.snap(free, places, within);
    if (to === free) return hundredths(free);
    this.#pulled[axis] = to;
    return to;
  }

  #scale(grip: Grip, x: number, y: number, event: PointerEvent): void {
    const { plot, domain } = this.#editor;
    if (!grip.frame || !grip.handle) return;
    this.#pulled = { time: null, value: null };
    let to: number;
    if (grip.handle === "top") {
      const free = Math.min(grip.frame.values[1] + (grip.y - y) * plot.perPixel.value, 1);
      to = this.#pulls(event) ? this.#pull("value", free, [1], PULL * plot.perPixel.value) : free;
    } else {
      const held = grip.frame.times[grip.handle === "left" ? 0 : 1];
      const free = held + (x - grip.x) * plot.perPixel.time;
      const within = PULL * plot.perPixel.time;
      to = this.#pulls(event) ? this.#pull("time", free, this.#places(), within) : free;
    }
    this.#editor.take(
      stretch(grip.curves, grip.chosen, domain, grip.frame, grip.handle, to),
      grip.merge,
    );
  }

  #dragBox(grip: Grip, x: number, y: number, extend: boolean): void {
    const { curves, plot, active } = this.#editor;
    const [left, right] = [Math.min(x, grip.x), Math.max(x, grip.x)];
    const [top, low] = [Math.min(y, grip.y), Math.max(y, grip.y)];
    const chosen = new Map(extend ? grip.chosen : []);
    for (const [name, keys] of Object.entries(curves)) {
      const inside = keys.flatMap(([time, value], index) => {
        const [keyX, keyY] = [plot.x(time), plot.y(value)];
        return keyX >= left && keyX <= right && keyY >= top && keyY <= low ? [index] : [];
      });
      const own = new Set([...(chosen.get(name) ?? []), ...inside]);
      if (own.size) chosen.set(name, own);
    }
    const first = [...chosen.keys()][0];
    this.#editor.pick(chosen, chosen.has(active) || !first ? active : first);
  }

  #release(): void {
    const grip = this.#grip;
    this.#grip = null;
    this.#pulled = { time: null, value: null };
    if (grip?.moved && grip.mode === "keys") this.#editor.tell();
    if (grip?.moved && grip.mode === "box")
      this.#editor.hooks.say(`${this.#editor.count} keys chosen`);
    this.#editor.refresh();
  }

  #hover(x: number, y: number): void {
    this.#hovered = this.#keyAt(x, y);
    this.#handle = this.#hovered ? null : this.#handleAt(x, y);
    this.#hot = this.#onBoundary(x, y);
    this.#editor.canvas.style.cursor = this.#cursor(x, y);
    this.#editor.refresh();
  }

  #cursor(x: number, y: number): string {
    if (this.#hot || (this.#handle && this.#handle !== "top")) return "ew-resize";
    if (this.#handle) return "ns-resize";
    if (this.#hovered) return "move";
    return this.#curveAt(x, y) ? "pointer" : "crosshair";
  }

  #leave(): void {
    this.at = null;
    this.#hovered = null;
    this.#handle = null;
    this.#hot = false;
    this.#editor.refresh();
  }

  #double(event: MouseEvent): void {
    const { x, y } = this.#place(event);
    if (this.#onBoundary(x, y)) return this.#editor.moveBoundary(0.5, "");
    if (this.#keyAt(x, y)) this.#editor.hooks.enter();
    else this.#addAt(x, y);
  }

  #addAt(x: number, y: number): void {
    const { plot } = this.#editor;
    this.#editor.insert([hundredths(plot.time(x)), hundredths(plot.value(y))]);
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const { plot } = this.#editor;
    const unit = event.deltaMode === 1 ? 24 : 1;
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY))
      plot.pan((event.deltaX || event.deltaY) * unit);
    else plot.zoom(Math.exp(event.deltaY * unit * 0.0015), this.#place(event).x);
    this.#editor.refresh();
  }

  #box(): Drawing["box"] {
    const [grip, at] = [this.#grip, this.at];
    if (grip?.mode !== "box" || !grip.moved || !at) return null;
    return {
      x: Math.min(grip.x, at.x),
      y: Math.min(grip.y, at.y),
      width: Math.abs(at.x - grip.x),
      height: Math.abs(at.y - grip.y),
    };
  }
}
