/** What was copied: kept with the browser, so that it can be pasted in another tab too. */

import type { Curves } from "./keys.ts";

export interface Copied {
  curves: Curves;
  /** Whether whole curves were copied, or keys out of them. */
  whole: boolean;
}

const PLACE = "lipwright-copied";
let held: Copied | null = null;

export function keep(copied: Copied): void {
  held = copied;
  try {
    localStorage.setItem(PLACE, JSON.stringify(copied));
  } catch {
    // A browser that keeps nothing still pastes within the page.
  }
}

export function copied(): Copied | null {
  try {
    const text = localStorage.getItem(PLACE);
    return text ? JSON.parse(text) : held;
  } catch {
    return held;
  }
}
