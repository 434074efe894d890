/**
 * The curve editor: keys of several poses over one normalised time. It knows nothing of where the
 * curves come from or go to; whoever shows something in it is told what was changed.
 */

import { readInk, type Ink } from "../../shared/ink.ts";
import { stroke } from "../../shared/palette.ts";
import { planeContext } from "../../shared/software.ts";
import { copied, keep } from "./clipboard.ts";
import * as act from "./keys.ts";
import type { Chosen, Curves, Domain, Key } from "./keys.ts";
import { paint, type Drawing } from "./paint.ts";
import { Plot } from "./plot.ts";
import type { Spline } from "./sampling.ts";

/** What is shown and edited. */
export interface Subject {
  /** Another subject has another name: then nothing stays chosen. */
  name: string;
  domain: Domain;
  curves: Curves;
  ghosts: Curves;
  /** All poses that there are, in order: their colours. */
  poses: string[];
  boundary: number | null;
  stretches: { label: string; from: number; to: number }[];
  spline: Spline;
  softness: Map<string, number>;
}

/** What came of a touch. `merge` is one name for all changes of one drag. */
export interface Hooks {
  changed(names: string[], curves: Curves, merge: string): void;
  moved(boundary: number, merge: string): void;
  chosen(): void;
  say(words: string): void;
  drag(): string;
  enter(): void;
  undo(): void;
  redo(): void;
}

const REACH = 9;
const LINE_REACH = 6;
const PULL = 7;

type Mode = "keys" | "box" | "boundary" | "pan";

interface Grip {
  mode: Mode;
  x: number;
  y: number;
  curves: Curves;
  chosen: Map<string, Set<number>>;
  lead: Key | null;
  merge: string;
  moved: boolean;
}

export class CurveEditor {
  readonly canvas: HTMLCanvasElement;
  readonly plot = new Plot();
  active = "";
  snapping = true;
  playhead: number | null = null;
  #hooks: Hooks;
  #subject: Subject | null = null;
  #curves: Curves = {};
  #chosen = new Map<string, Set<number>>();
  #grip: Grip | null = null;
  #hovered: { name: string; index: number } | null = null;
  #pointer: { x: number; y: number } | null = null;
  #pulled: Drawing["pulled"] = { time: null, value: null };
  #hot = false;
  #ink: Ink;
  #asked = false;

  constructor(canvas: HTMLCanvasElement, hooks: Hooks) {
    this.canvas = canvas;
    this.#hooks = hooks;
    this.#ink = readInk(canvas);
    canvas.addEventListener("pointerdown", (event) => this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", () => this.#release());
    canvas.addEventListener("pointercancel", () => this.cancel());
    canvas.addEventListener("pointerleave", () => this.#leave());
    canvas.addEventListener("dblclick", (event) => this.#double(event));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("focus", () => this.refresh());
    canvas.addEventListener("blur", () => this.refresh());
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    new ResizeObserver(() => this.#resize()).observe(canvas);
  }

  get curves(): Curves {
    return this.#curves;
  }

  get chosen(): Chosen {
    return this.#chosen;
  }

  get subject(): Subject | null {
    return this.#subject;
  }

  /** Whether something is being dragged: then what is shown is newer than what the server has. */
  get dragging(): boolean {
    return this.#grip !== null && this.#grip.mode !== "pan";
  }

  show(subject: Subject | null): void {
    const other = subject?.name !== this.#subject?.name;
    this.#subject = subject;
    this.#curves = subject ? subject.curves : {};
    if (other) {
      this.#chosen.clear();
      this.#grip = null;
      this.#hovered = null;
    }
    if (subject) this.plot.show(subject.domain);
    if (other) this.plot.fit();
    if (other && !this.#curves[this.active]) this.active = strongest(this.#curves) || this.active;
    this.#keepValid();
    this.refresh();
    this.#hooks.chosen();
  }

  activate(name: string): void {
    if (name === this.active) return;
    this.active = name;
    this.#chosen.clear();
    this.refresh();
    this.#hooks.chosen();
  }

  choose(name: string, indexes: number[]): void {
    this.active = name;
    this.#chosen = new Map(indexes.length ? [[name, new Set(indexes)]] : []);
    this.refresh();
    this.#hooks.chosen();
    this.#tell();
  }

  chooseAll(names = [this.active]): void {
    this.#chosen = act.everything(this.#curves, names);
    this.refresh();
    this.#hooks.chosen();
    this.#hooks.say(`${this.count} keys chosen`);
  }

  chooseNone(): void {
    this.#chosen.clear();
    this.refresh();
    this.#hooks.chosen();
  }

  get count(): number {
    return [...this.#chosen.values()].reduce((sum, { size }) => sum + size, 0);
  }

  /** Choose the next key of the active curve, or the one before. */
  step(way: 1 | -1, extend = false): void {
    const keys = this.#curves[this.active];
    if (!keys?.length) return;
    const picked = [...(this.#chosen.get(this.active) ?? [])].sort((a, b) => a - b);
    const from = picked.length
      ? picked[way > 0 ? picked.length - 1 : 0]
      : way > 0
        ? -1
        : keys.length;
    const to = Math.min(Math.max(from + way, 0), keys.length - 1);
    this.choose(this.active, extend ? [...new Set([...picked, to])] : [to]);
  }

  /** Move what is chosen; where nothing is, choose the first key. */
  nudge(time: number, value: number): void {
    if (!this.count) return this.step(1);
    this.#apply(act.move(this.#curves, this.#chosen, this.domain, time, value), "");
    this.#tell();
  }

  place(index: number, to: Key): void {
    const keys = this.#curves[this.active];
    if (!keys?.[index]) return;
    const placed = act.place(keys, index, to, this.domain);
    this.#apply({ ...this.#curves, [this.active]: placed }, "");
  }

  insert(key: Key): void {
    if (!this.active) return;
    const { keys, index } = act.insert(this.#curves[this.active] ?? [], key, this.domain);
    this.#apply({ ...this.#curves, [this.active]: keys }, "");
    this.choose(this.active, [index]);
  }

  /** A key on the curve: under the pointer, or midway after the one that is chosen. */
  insertHere(): void {
    const keys = this.#curves[this.active] ?? [];
    const picked = Math.max(-1, ...(this.#chosen.get(this.active) ?? []));
    let time = (this.domain.first + this.domain.last) / 2;
    if (this.#pointer && !this.count) time = this.plot.time(this.#pointer.x);
    else if (picked >= 0 && picked < keys.length - 1)
      time = (keys[picked][0] + keys[picked + 1][0]) / 2;
    else if (picked > 0) time = (keys[picked - 1][0] + keys[picked][0]) / 2;
    this.insert([time, act.valueAt(keys, time)]);
  }

  remove(): void {
    if (!this.count) return;
    const count = this.count;
    const first = Math.min(...(this.#chosen.get(this.active) ?? [0]));
    const curves = act.remove(this.#curves, this.#chosen, this.domain);
    this.#chosen.clear();
    if (curves[this.active]) this.#chosen.set(this.active, new Set([Math.max(first - 1, 0)]));
    this.#apply(curves, "");
    this.#hooks.say(`${count} keys taken away`);
  }

  mirror(): void {
    this.#apply(act.mirror(this.#curves, this.#target(), this.domain), "");
  }

  scaleValues(by: number): void {
    this.#apply(act.scaleValues(this.#curves, this.#target(), this.domain, by), "");
  }

  scaleTimes(by: number): void {
    this.#apply(act.scaleTimes(this.#curves, this.#target(), this.domain, by), "");
  }

  /** Copy the chosen keys, or the active curve where none is chosen, or all curves. */
  copy(all = false): void {
    const chosen = all ? act.everything(this.#curves, Object.keys(this.#curves)) : this.#target();
    const curves: Curves = {};
    for (const [name, picked] of chosen)
      curves[name] = (this.#curves[name] ?? []).filter((_, index) => picked.has(index));
    const whole = all || !this.count;
    keep({ curves, whole });
    const names = Object.keys(curves);
    this.#hooks.say(`copied ${names.join(", ")}${whole ? "" : `, ${this.count} keys`}`);
  }

  /** Paste: one curve goes into the active pose, several each into their own. */
  paste(): void {
    const held = copied();
    if (!held) return this.#hooks.say("nothing has been copied");
    const names = Object.keys(held.curves);
    const result = { ...this.#curves };
    const known = this.#subject?.poses ?? [];
    for (const name of names) {
      const into = names.length === 1 ? this.active : name;
      if (!known.includes(into)) continue;
      const own = held.whole ? [] : (result[into] ?? []);
      result[into] = act.paste(own, held.curves[name], this.domain);
    }
    this.#apply(result, "");
    this.#hooks.say(`pasted ${names.join(", ")}`);
  }

  /** Give the active pose a curve, or take it out. */
  draw(name: string, keys: Key[] | null): void {
    const curves = { ...this.#curves };
    if (keys) curves[name] = keys;
    else delete curves[name];
    this.#chosen.clear();
    this.#apply(curves, "");
  }

  /** Give up what is being dragged. */
  cancel(): void {
    const grip = this.#grip;
    this.#grip = null;
    this.#pulled = { time: null, value: null };
    if (grip?.mode === "keys" && grip.moved) this.#apply(grip.curves, grip.merge);
    this.refresh();
  }

  fit(): void {
    this.plot.fit();
    this.refresh();
  }

  zoom(factor: number): void {
    this.plot.zoom(factor, this.#pointer?.x ?? (this.plot.left + this.plot.right) / 2);
    this.refresh();
  }

  restyle(): void {
    this.#ink = readInk(this.canvas);
    this.refresh();
  }

  /** Draw anew with the next picture. */
  refresh(): void {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      this.#paint();
    });
  }

  /** Where a key is on the page, for those who want to drag it. */
  placeOf(name: string, index: number): { x: number; y: number } | null {
    const key = this.#curves[name]?.[index];
    if (!key) return null;
    const box = this.canvas.getBoundingClientRect();
    return { x: box.left + this.plot.x(key[0]), y: box.top + this.plot.y(key[1]) };
  }

  get domain(): Domain {
    return this.#subject?.domain ?? { first: 0, last: 1, rests: true };
  }

  #target(): Map<string, Set<number>> {
    return this.count ? this.#chosen : act.everything(this.#curves, [this.active]);
  }

  #apply(curves: Curves, merge: string): void {
    const names = [...new Set([...Object.keys(curves), ...Object.keys(this.#curves)])];
    const changed = names.filter((name) => !same(curves[name], this.#curves[name]));
    this.#curves = curves;
    this.#keepValid();
    this.refresh();
    this.#hooks.chosen();
    if (changed.length) this.#hooks.changed(changed, curves, merge);
  }

  #keepValid(): void {
    for (const [name, picked] of this.#chosen) {
      const length = this.#curves[name]?.length ?? 0;
      const kept = [...picked].filter((index) => index < length);
      if (kept.length) this.#chosen.set(name, new Set(kept));
      else this.#chosen.delete(name);
    }
  }

  #tell(): void {
    const keys = this.#curves[this.active];
    const [index] = this.#chosen.get(this.active) ?? [];
    if (!keys || index === undefined) return;
    if (this.count > 1) return this.#hooks.say(`${this.count} keys`);
    const [time, value] = keys[index];
    const number = `key ${index + 1} of ${keys.length}`;
    this.#hooks.say(`${this.active}, ${number}, time ${time}, weight ${value}`);
  }

  // What the pointer does

  #at(event: MouseEvent): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #keyAt(x: number, y: number): { name: string; index: number } | null {
    let best: { name: string; index: number } | null = null;
    let least = REACH;
    for (const [name, keys] of Object.entries(this.#curves))
      keys.forEach(([time, value], index) => {
        const far = Math.hypot(this.plot.x(time) - x, this.plot.y(value) - y);
        // Of keys on each other that of the active curve is meant.
        const counted = name === this.active ? far - 3 : far;
        if (counted < least) [best, least] = [{ name, index }, counted];
      });
    return best;
  }

  #curveAt(x: number, y: number): string | null {
    let best: string | null = null;
    let least = LINE_REACH;
    for (const [name, keys] of Object.entries(this.#curves)) {
      const value = act.valueAt(keys, this.plot.time(x));
      const far = Math.abs(this.plot.y(value) - y);
      if (value > 0 && far < least) [best, least] = [name, far];
    }
    return best;
  }

  #onBoundary(x: number, y: number): boolean {
    const boundary = this.#subject?.boundary;
    if (boundary === null || boundary === undefined) return false;
    return Math.abs(this.plot.x(boundary) - x) < 8 && y > this.plot.bottom + 4;
  }

  #press(event: PointerEvent): void {
    if (!this.#subject) return;
    const at = this.#at(event);
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    const grip: Grip = {
      mode: "box",
      ...at,
      curves: this.#curves,
      chosen: this.#chosen,
      lead: null,
      merge: "",
      moved: false,
    };
    this.#grip = grip;
    if (event.button === 1 || event.button === 2) grip.mode = "pan";
    else if (this.#onBoundary(at.x, at.y)) {
      grip.mode = "boundary";
      grip.merge = this.#hooks.drag();
    } else {
      const key = this.#keyAt(at.x, at.y);
      if (key) this.#grasp(grip, key, event);
      else if (event.ctrlKey || event.metaKey) this.#addAt(at.x, at.y);
      else if (!event.shiftKey) {
        const curve = this.#curveAt(at.x, at.y);
        if (curve) this.activate(curve);
        else this.chooseNone();
      }
    }
    event.preventDefault();
    this.refresh();
  }

  #grasp(grip: Grip, key: { name: string; index: number }, event: PointerEvent): void {
    const picked = this.#chosen.get(key.name)?.has(key.index) ?? false;
    this.active = key.name;
    if (event.shiftKey) {
      const own = new Set(this.#chosen.get(key.name));
      if (picked) own.delete(key.index);
      else own.add(key.index);
      this.#chosen = new Map(this.#chosen);
      if (own.size) this.#chosen.set(key.name, own);
      else this.#chosen.delete(key.name);
    } else if (!picked) this.#chosen = new Map([[key.name, new Set([key.index])]]);
    grip.mode = "keys";
    grip.chosen = this.#chosen;
    grip.lead = this.#curves[key.name][key.index];
    grip.merge = this.#hooks.drag();
    this.#hooks.chosen();
    this.#tell();
  }

  #move(event: PointerEvent): void {
    const at = this.#at(event);
    this.#pointer = at;
    const grip = this.#grip;
    if (!grip) return this.#hover(at.x, at.y);
    const far = Math.hypot(at.x - grip.x, at.y - grip.y);
    if (!grip.moved && far < 3) return;
    grip.moved = true;
    if (grip.mode === "pan") {
      this.plot.pan(grip.x - at.x);
      grip.x = at.x;
    } else if (grip.mode === "boundary") this.#dragBoundary(at.x, event, grip.merge);
    else if (grip.mode === "keys") this.#dragKeys(grip, at.x, at.y, event);
    else this.#dragBox(grip, at.x, at.y, event.shiftKey);
    this.refresh();
  }

  #dragBoundary(x: number, event: PointerEvent, merge: string): void {
    const free = this.plot.time(x);
    const pulled = this.#pulls(event)
      ? act.snap(free, [0.5], PULL * this.plot.perPixel.time)
      : free;
    const boundary = Math.round(Math.min(Math.max(pulled, 0.01), 0.99) * 100) / 100;
    if (this.#subject && boundary !== this.#subject.boundary) {
      this.#subject = { ...this.#subject, boundary };
      this.#hooks.moved(boundary, merge);
    }
  }

  #pulls(event: PointerEvent): boolean {
    return this.snapping !== event.altKey;
  }

  #dragKeys(grip: Grip, x: number, y: number, event: PointerEvent): void {
    const slow = event.shiftKey ? 0.25 : 1;
    const { time: perX, value: perY } = this.plot.perPixel;
    let byTime = (x - grip.x) * perX * slow;
    let byValue = (grip.y - y) * perY * slow;
    if (event.ctrlKey || event.metaKey) {
      if (Math.abs(x - grip.x) > Math.abs(y - grip.y)) byValue = 0;
      else byTime = 0;
    }
    this.#pulled = { time: null, value: null };
    if (grip.lead && this.#pulls(event)) {
      const [time, value] = grip.lead;
      const places = [0, 1, ...(this.#subject?.boundary ? [this.#subject.boundary] : [])];
      const toTime = act.snap(time + byTime, places, PULL * perX * slow);
      if (toTime !== time + byTime) this.#pulled.time = toTime;
      byTime = (this.#pulled.time ?? Math.round(toTime * 100) / 100) - time;
      const toValue = act.snap(value + byValue, [0, 1], PULL * perY * slow);
      if (toValue !== value + byValue) this.#pulled.value = toValue;
      byValue = (this.#pulled.value ?? Math.round(toValue * 100) / 100) - value;
    }
    const moved = act.move(grip.curves, grip.chosen, this.domain, byTime, byValue);
    this.#apply(moved, grip.merge);
  }

  #dragBox(grip: Grip, x: number, y: number, extend: boolean): void {
    const [left, right] = [Math.min(x, grip.x), Math.max(x, grip.x)];
    const [top, low] = [Math.min(y, grip.y), Math.max(y, grip.y)];
    const chosen = new Map(extend ? grip.chosen : []);
    for (const [name, keys] of Object.entries(this.#curves)) {
      const inside = keys.flatMap(([time, value], index) => {
        const [keyX, keyY] = [this.plot.x(time), this.plot.y(value)];
        return keyX >= left && keyX <= right && keyY >= top && keyY <= low ? [index] : [];
      });
      const own = new Set([...(chosen.get(name) ?? []), ...inside]);
      if (own.size) chosen.set(name, own);
    }
    this.#chosen = chosen;
    if (chosen.size && !chosen.has(this.active)) this.active = [...chosen.keys()][0];
    this.#hooks.chosen();
  }

  #release(): void {
    const grip = this.#grip;
    this.#grip = null;
    this.#pulled = { time: null, value: null };
    if (grip?.mode === "keys" && grip.moved) this.#tell();
    if (grip?.mode === "box" && grip.moved) this.#hooks.say(`${this.count} keys chosen`);
    this.refresh();
  }

  #hover(x: number, y: number): void {
    this.#hovered = this.#keyAt(x, y);
    this.#hot = this.#onBoundary(x, y);
    const line = !this.#hovered && this.#curveAt(x, y);
    this.canvas.style.cursor = this.#hot
      ? "ew-resize"
      : this.#hovered
        ? "move"
        : line
          ? "pointer"
          : "crosshair";
    this.refresh();
  }

  #leave(): void {
    this.#pointer = null;
    this.#hovered = null;
    this.#hot = false;
    this.refresh();
  }

  #double(event: MouseEvent): void {
    const { x, y } = this.#at(event);
    if (this.#onBoundary(x, y)) return this.#hooks.moved(0.5, "");
    if (!this.#keyAt(x, y)) this.#addAt(x, y);
    else this.#hooks.enter();
  }

  #addAt(x: number, y: number): void {
    const round = (value: number) => Math.round(value * 100) / 100;
    this.insert([round(this.plot.time(x)), round(this.plot.value(y))]);
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 24 : 1;
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY))
      this.plot.pan((event.deltaX || event.deltaY) * unit);
    else this.plot.zoom(Math.exp(event.deltaY * unit * 0.0015), this.#at(event).x);
    this.refresh();
  }

  /** What the pointer or the chosen key says, in words. */
  readout(): string {
    const format = (value: number) => value.toFixed(3).replace(/0$/, "");
    if (this.#grip?.mode === "keys" && this.#grip.lead) {
      const [index] = this.#chosen.get(this.active) ?? [0];
      const key = this.#curves[this.active]?.[index];
      if (key && this.count === 1) return `t ${format(key[0])}   w ${format(key[1])}`;
    }
    if (this.count > 1) return `${this.count} keys`;
    if (!this.#pointer) return "";
    const time = this.plot.time(this.#pointer.x);
    const value = Math.min(Math.max(this.plot.value(this.#pointer.y), 0), 1);
    return `t ${format(time)}   w ${format(value)}`;
  }

  // What is drawn

  #resize(): void {
    const density = Math.min(devicePixelRatio, 3);
    const { clientWidth, clientHeight } = this.canvas;
    this.plot.width = clientWidth;
    this.plot.height = clientHeight;
    this.canvas.width = Math.round(clientWidth * density);
    this.canvas.height = Math.round(clientHeight * density);
    this.#paint();
  }

  #paint(): void {
    const subject = this.#subject;
    const context = planeContext(this.canvas);
    const density = this.canvas.width / Math.max(this.plot.width, 1);
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, this.plot.width, this.plot.height);
    if (!subject) return;
    const strokes = new Map(
      subject.poses.map((name, index) => [name, stroke(index, this.#ink.dark)]),
    );
    paint(context, {
      plot: this.plot,
      ink: this.#ink,
      curves: this.#curves,
      ghosts: subject.ghosts,
      before: this.#grip?.mode === "keys" && this.#grip.moved ? this.#grip.curves : null,
      active: this.active,
      chosen: this.#chosen,
      hovered: this.#hovered,
      strokes,
      spline: subject.spline,
      softness: subject.softness,
      boundary: subject.boundary,
      boundaryHot: this.#hot || this.#grip?.mode === "boundary",
      stretches: subject.stretches,
      box: this.#box(),
      playhead: this.playhead,
      pulled: this.#pulled,
      focused: document.activeElement === this.canvas,
    });
  }

  #box(): Drawing["box"] {
    const [grip, at] = [this.#grip, this.#pointer];
    if (grip?.mode !== "box" || !grip.moved || !at) return null;
    return {
      x: Math.min(grip.x, at.x),
      y: Math.min(grip.y, at.y),
      width: Math.abs(at.x - grip.x),
      height: Math.abs(at.y - grip.y),
    };
  }
}

/** The pose with the greatest weight: what one wants to see first. */
function strongest(curves: Curves): string {
  const peak = (keys: Key[]) => Math.max(0, ...keys.map(([, value]) => value));
  return Object.keys(curves).reduce(
    (best, name) => (!best || peak(curves[name]) > peak(curves[best]) ? name : best),
    "",
  );
}

function same(a: Key[] | undefined, b: Key[] | undefined): boolean {
  if (!a || !b || a.length !== b.length) return a === b;
  return a.every(([time, value], index) => time === b[index][0] && value === b[index][1]);
}
