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
import { paint } from "./paint.ts";
import { Plot } from "./plot.ts";
import { CurvePointer } from "./pointer.ts";
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
}

/** Milliseconds after which a key that is pressed again begins another step of undo. */
const PAUSE = 700;

export class CurveEditor {
  readonly canvas: HTMLCanvasElement;
  readonly plot = new Plot();
  active = "";
  snapping = true;
  playhead: number | null = null;
  readonly hooks: Hooks;
  #subject: Subject | null = null;
  #curves: Curves = {};
  #chosen = new Map<string, Set<number>>();
  #pointer: CurvePointer;
  #ink: Ink;
  #asked = false;
  #last = { kind: "", at: 0, merge: "" };

  constructor(canvas: HTMLCanvasElement, hooks: Hooks) {
    this.canvas = canvas;
    this.hooks = hooks;
    this.#ink = readInk(canvas);
    this.#pointer = new CurvePointer(this);
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
    return this.#pointer.changing;
  }

  show(subject: Subject | null): void {
    const other = subject?.name !== this.#subject?.name;
    this.#subject = subject;
    this.#curves = subject ? subject.curves : {};
    if (other) {
      this.#chosen.clear();
      this.#pointer.forget();
    }
    if (subject) this.plot.show(subject.domain);
    if (other) this.plot.fit();
    if (other && !this.#curves[this.active])
      this.active = act.mostSeen(this.#curves) || this.active;
    this.#keepValid();
    this.refresh();
    this.hooks.chosen();
  }

  activate(name: string): void {
    if (name === this.active) return;
    this.active = name;
    this.#chosen.clear();
    this.refresh();
    this.hooks.chosen();
  }

  choose(name: string, indexes: number[]): void {
    this.#last.kind = "";
    this.active = name;
    this.#chosen = new Map(indexes.length ? [[name, new Set(indexes)]] : []);
    this.refresh();
    this.hooks.chosen();
    this.tell();
  }

  chooseAll(names = [this.active]): void {
    this.#chosen = act.everything(this.#curves, names);
    this.refresh();
    this.hooks.chosen();
    this.hooks.say(`${this.count} keys chosen`);
  }

  chooseNone(): void {
    this.#chosen.clear();
    this.refresh();
    this.hooks.chosen();
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
    const moved = act.move(this.#curves, this.#chosen, this.domain, time, value);
    this.take(moved, this.#burst("nudge"));
    this.tell();
  }

  place(index: number, to: Key): void {
    const keys = this.#curves[this.active];
    if (!keys?.[index]) return;
    const placed = act.place(keys, index, to, this.domain);
    this.take({ ...this.#curves, [this.active]: placed });
  }

  insert(key: Key): void {
    if (!this.active) return;
    const { keys, index } = act.insert(this.#curves[this.active] ?? [], key, this.domain);
    this.take({ ...this.#curves, [this.active]: keys });
    this.choose(this.active, [index]);
  }

  /** A key on the curve: under the pointer, or midway after the one that is chosen. */
  insertHere(): void {
    const keys = this.#curves[this.active] ?? [];
    const picked = Math.max(-1, ...(this.#chosen.get(this.active) ?? []));
    let time = (this.domain.first + this.domain.last) / 2;
    const { at } = this.#pointer;
    if (at && !this.count) time = this.plot.time(at.x);
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
    this.take(curves);
    this.hooks.say(`${count} keys taken away`);
  }

  mirror(): void {
    this.take(act.mirror(this.#curves, this.#target(), this.domain));
  }

  scaleValues(by: number): void {
    const scaled = act.scaleValues(this.#curves, this.#target(), this.domain, by);
    this.take(scaled, this.#burst("values"));
  }

  scaleTimes(by: number): void {
    const scaled = act.scaleTimes(this.#curves, this.#target(), this.domain, by);
    this.take(scaled, this.#burst("times"));
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
    this.hooks.say(`copied ${names.join(", ")}${whole ? "" : `, ${this.count} keys`}`);
  }

  /** Paste: one curve goes into the active pose, several each into their own. */
  paste(): void {
    const held = copied();
    if (!held) return this.hooks.say("nothing has been copied");
    const names = Object.keys(held.curves);
    const result = { ...this.#curves };
    const known = this.#subject?.poses ?? [];
    for (const name of names) {
      const into = names.length === 1 ? this.active : name;
      if (!known.includes(into)) continue;
      const own = held.whole ? [] : (result[into] ?? []);
      result[into] = act.paste(own, held.curves[name], this.domain);
    }
    this.take(result);
    this.hooks.say(`pasted ${names.join(", ")}`);
  }

  /** Give the active pose a curve, or take it out. */
  draw(name: string, keys: Key[] | null): void {
    const curves = { ...this.#curves };
    if (keys) curves[name] = keys;
    else delete curves[name];
    this.#chosen.clear();
    this.take(curves);
  }

  /** Give up what is being dragged. */
  cancel(): void {
    this.#pointer.cancel();
  }

  fit(): void {
    this.plot.fit();
    this.refresh();
  }

  zoom(factor: number): void {
    this.plot.zoom(factor, this.#pointer.at?.x ?? (this.plot.left + this.plot.right) / 2);
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

  /** One name for the same thing done again and again: it is one step of undo. */
  #burst(kind: string): string {
    const now = performance.now();
    const again = this.#last.kind === kind && now - this.#last.at < PAUSE;
    this.#last = { kind, at: now, merge: again ? this.#last.merge : this.hooks.drag() };
    return this.#last.merge;
  }

  #target(): Map<string, Set<number>> {
    return this.count ? this.#chosen : act.everything(this.#curves, [this.active]);
  }

  /** Show curves as they are now, and tell whoever keeps them. */
  take(curves: Curves, merge = ""): void {
    const names = [...new Set([...Object.keys(curves), ...Object.keys(this.#curves)])];
    const changed = names.filter((name) => !act.same(curves[name], this.#curves[name]));
    this.#curves = curves;
    this.#keepValid();
    this.refresh();
    this.hooks.chosen();
    if (changed.length) this.hooks.changed(changed, curves, merge);
  }

  #keepValid(): void {
    for (const [name, picked] of this.#chosen) {
      const length = this.#curves[name]?.length ?? 0;
      const kept = [...picked].filter((index) => index < length);
      if (kept.length) this.#chosen.set(name, new Set(kept));
      else this.#chosen.delete(name);
    }
  }

  /** Choose keys, as a pointer does: of one curve or of several. */
  pick(chosen: Map<string, Set<number>>, active = this.active): void {
    this.#last.kind = "";
    this.#chosen = chosen;
    this.active = active;
    this.hooks.chosen();
    this.refresh();
  }

  /** The boundary of the two phones is being moved. */
  moveBoundary(boundary: number, merge: string): void {
    if (!this.#subject || boundary === this.#subject.boundary) return;
    this.#subject = { ...this.#subject, boundary };
    this.hooks.moved(boundary, merge);
    this.refresh();
  }

  readout(): string {
    return this.#pointer.readout();
  }

  /** Say which key is chosen. */
  tell(): void {
    const keys = this.#curves[this.active];
    const [index] = this.#chosen.get(this.active) ?? [];
    if (!keys || index === undefined) return;
    if (this.count > 1) return this.hooks.say(`${this.count} keys`);
    const [time, value] = keys[index];
    const number = `key ${index + 1} of ${keys.length}`;
    this.hooks.say(`${this.active}, ${number}, time ${time}, weight ${value}`);
  }

  // What is drawn

  #resize(): void {
    const density = Math.min(devicePixelRatio, 3);
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight) return;
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
      active: this.active,
      chosen: this.#chosen,
      strokes,
      spline: subject.spline,
      softness: subject.softness,
      boundary: subject.boundary,
      stretches: subject.stretches,
      playhead: this.playhead,
      ...this.#pointer.marks(),
    });
  }
}
