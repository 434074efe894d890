/** Where times and weights lie on the canvas of the curve editor. */

import type { Domain } from "./keys.ts";

const MARGIN = { left: 38, right: 16, top: 14, bottom: 42 };
/** Air above 1 and below 0, as a share of a weight. */
const AIR = 0.04;
const NEAREST = 0.02;

export class Plot {
  width = 1;
  height = 1;
  from = 0;
  to = 1;
  #domain: Domain = { first: 0, last: 1, rests: true };

  show(domain: Domain): void {
    const same = domain.first === this.#domain.first && domain.last === this.#domain.last;
    this.#domain = domain;
    if (!same) this.fit();
  }

  fit(): void {
    this.from = this.#domain.first;
    this.to = this.#domain.last;
  }

  get left(): number {
    return MARGIN.left;
  }

  get right(): number {
    return Math.max(this.width - MARGIN.right, MARGIN.left + 1);
  }

  get top(): number {
    return MARGIN.top;
  }

  get bottom(): number {
    return Math.max(this.height - MARGIN.bottom, MARGIN.top + 1);
  }

  get zoomed(): boolean {
    return this.to - this.from < this.#domain.last - this.#domain.first - 1e-9;
  }

  x(time: number): number {
    return this.left + ((time - this.from) / (this.to - this.from)) * (this.right - this.left);
  }

  y(value: number): number {
    return this.bottom - ((value + AIR) / (1 + 2 * AIR)) * (this.bottom - this.top);
  }

  time(x: number): number {
    return this.from + ((x - this.left) / (this.right - this.left)) * (this.to - this.from);
  }

  value(y: number): number {
    return ((this.bottom - y) / (this.bottom - this.top)) * (1 + 2 * AIR) - AIR;
  }

  /** Seconds, or shares, of one pixel. */
  get perPixel(): { time: number; value: number } {
    return {
      time: (this.to - this.from) / (this.right - this.left),
      value: (1 + 2 * AIR) / (this.bottom - this.top),
    };
  }

  /** Zoom in time, keeping what lies under `x`. */
  zoom(factor: number, x: number): void {
    const all = this.#domain.last - this.#domain.first;
    const span = Math.min(Math.max((this.to - this.from) * factor, NEAREST), all);
    const still = this.time(x);
    const share = (x - this.left) / (this.right - this.left);
    this.#place(still - share * span, span);
  }

  pan(pixels: number): void {
    this.#place(this.from + pixels * this.perPixel.time, this.to - this.from);
  }

  #place(from: number, span: number): void {
    const { first, last } = this.#domain;
    this.from = Math.min(Math.max(from, first), last - span);
    this.to = this.from + span;
  }
}
