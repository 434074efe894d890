/** Changes that come faster than they are answered: of those that wait only the last is sent. */

import type { Change } from "../protocol.ts";
import type { Session } from "./session.ts";

let drags = 0;

/** A name for one drag: its changes are one step of undo. */
export function dragName(what: string): string {
  return `${what}-${performance.timeOrigin.toFixed(0)}-${++drags}`;
}

export class Stream {
  #session: Session;
  /** What waits, by its drag and its place. */
  #waiting = new Map<string, { change: Change; merge: string }>();
  #busy = false;

  constructor(session: Session) {
    this.#session = session;
  }

  /** Whether a change is on its way or waits. */
  get busy(): boolean {
    return this.#busy;
  }

  push(change: Change, merge: string): void {
    this.#waiting.set(`${merge} ${placeOf(change)}`, { change, merge });
    if (!this.#busy) void this.#run();
  }

  async #run(): Promise<void> {
    this.#busy = true;
    for (const [key, { change, merge }] of this.#waiting) {
      this.#waiting.delete(key);
      await this.#session.edit(change, merge);
    }
    this.#busy = false;
  }
}

/** What a change is about: a later one of the same drag and place makes it needless. */
function placeOf(change: Change): string {
  const pose = "pose" in change ? change.pose : "edit" in change ? change.edit.pose : "";
  return `${change.type} ${pose}`;
}
