/**
 * The time of the performance. It only counts; what it counts is given: seconds of sound that
 * have left the loudspeaker, or, where there is no sound, seconds of the wall.
 */

export interface Range {
  start: number;
  end: number;
}

export class Clock {
  speed = 1;
  loop: Range | null = null;
  #whole: Range;
  #from: number;
  #anchor: number | null = null;
  #tick: () => number;

  constructor(whole: Range, tick: () => number) {
    this.#whole = whole;
    this.#from = whole.start;
    this.#tick = tick;
  }

  get playing(): boolean {
    return this.#anchor !== null;
  }

  /** Start counting: the tick `anchor`, now or soon, is the present time. */
  play(anchor: number): void {
    this.#from = this.time();
    this.#anchor = anchor;
  }

  pause(): void {
    this.#from = this.time();
    this.#anchor = null;
  }

  /** Go to a time while paused. */
  seek(time: number): void {
    this.#from = Math.min(Math.max(time, this.#whole.start), this.#whole.end);
  }

  /** Count something else from now on; only while paused. */
  count(tick: () => number): void {
    this.#tick = tick;
  }

  time(): number {
    if (this.#anchor === null) return this.#from;
    const elapsed = Math.max(this.#tick() - this.#anchor, 0) * this.speed;
    const time = this.#from + elapsed;
    const loop = this.loop;
    if (loop && this.#from < loop.end && time >= loop.end)
      return loop.start + ((time - loop.start) % (loop.end - loop.start));
    return Math.min(time, this.#whole.end);
  }

  /** Whether it has run to the end, where nothing is left to play. */
  get ended(): boolean {
    return this.time() >= this.#whole.end - 1e-6;
  }
}
