/** Which part of time a width of pixels shows, and how far it may be zoomed and moved. */

import type { Range } from "./clock.ts";

const SHORTEST = 0.1;

export class Scale {
  readonly whole: Range;
  start: number;
  end: number;
  #width = 1;

  constructor(whole: Range) {
    this.whole = whole;
    this.start = whole.start;
    this.end = whole.end;
  }

  get span(): number {
    return this.end - this.start;
  }

  get zoomed(): boolean {
    return this.span < this.whole.end - this.whole.start - 1e-6;
  }

  get width(): number {
    return this.#width;
  }

  set width(pixels: number) {
    this.#width = Math.max(pixels, 1);
  }

  x(time: number): number {
    return ((time - this.start) / this.span) * this.#width;
  }

  time(x: number): number {
    return this.start + (x / this.#width) * this.span;
  }

  /** Show `span` seconds, keeping the time at `x` where it is. */
  zoom(span: number, x: number): void {
    const all = this.whole.end - this.whole.start;
    const length = Math.min(Math.max(span, Math.min(SHORTEST, all)), all);
    const still = this.time(x);
    this.#place(still - (x / this.#width) * length, length);
  }

  /** Move the part that is shown by a number of pixels. */
  pan(pixels: number): void {
    this.#place(this.start + (pixels / this.#width) * this.span, this.span);
  }

  /** Turn the page when `time` has left it; returns whether it was turned. */
  follow(time: number): boolean {
    if (!this.zoomed || (time >= this.start && time <= this.end)) return false;
    const before = this.start;
    this.#place(time - 0.06 * this.span, this.span);
    return this.start !== before;
  }

  /** Show the part whose middle is `time`. */
  centre(time: number): void {
    this.#place(time - this.span / 2, this.span);
  }

  #place(start: number, span: number): void {
    const last = this.whole.end - span;
    this.start = Math.max(Math.min(start, last), this.whole.start);
    this.end = this.start + span;
  }
}
