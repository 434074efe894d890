/** How long an edit takes to be seen, and how many pictures a second are drawn. */

const KEPT = 200;

export class Measure {
  readonly latencies: number[] = [];
  #touched: number | null = null;
  #arrived = false;
  #drawn: number[] = [];

  /** An edit has begun. */
  touch(): void {
    this.#touched ??= performance.now();
  }

  /** The motion that came of it is here. */
  arrive(): void {
    if (this.#touched !== null) this.#arrived = true;
  }

  /** A picture has been drawn. */
  draw(): void {
    const now = performance.now();
    this.#drawn.push(now);
    while (this.#drawn.length && this.#drawn[0] < now - 1000) this.#drawn.shift();
    if (!this.#arrived || this.#touched === null) return;
    this.latencies.push(now - this.#touched);
    if (this.latencies.length > KEPT) this.latencies.shift();
    this.#touched = null;
    this.#arrived = false;
  }

  get pictures(): number {
    return this.#drawn.length;
  }
}
