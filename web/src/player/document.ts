/** What `lipwright` put into the page: an animation, a model, and perhaps a sound. */

import { curves, endOf, type Curves } from "../shared/curves.ts";
import type { Range } from "../shared/clock.ts";
import type { Turn } from "../shared/model.ts";
import type { Span } from "../shared/spans.ts";

type Row = [string, number, number];

/** The content of the block `lipwright-performance`. */
export interface Content {
  text: string;
  engine: string;
  report: Record<string, unknown>;
  notes: string[];
  rate: number;
  start: number;
  controls: string[];
  frames: number[][];
  phones: Row[];
  words: Row[];
  model: string;
  /** Whether the model looks along -z, as those of VRM 0 do. */
  backwards: boolean;
  channels: { names: string[]; rate: number; start: number; frames: number[][] };
  /** The channels that turn joints. */
  joints: Record<string, Turn>;
}

export interface Performance {
  content: Content;
  controls: Curves;
  channels: Curves;
  phones: Span[];
  words: Span[];
}

export function performanceOf(content: Content): Performance {
  const span = ([label, start, end]: Row): Span => ({ label, start, end });
  const { names, rate, start, frames } = content.channels;
  return {
    content,
    controls: curves(content.controls, content.rate, content.start, content.frames),
    channels: curves(names, rate, start, frames),
    phones: content.phones.map(span),
    words: content.words.map(span),
  };
}

/** All that there is to play: from the first of sound, frames and phones to the last. */
export function wholeOf(performance: Performance, soundEnd: number): Range {
  const { controls, phones } = performance;
  return {
    start: Math.min(0, controls.start, phones[0]?.start ?? 0),
    end: Math.max(endOf(controls), soundEnd, phones.at(-1)?.end ?? 0, 1 / controls.rate),
  };
}

export function fromBase64(text: string): ArrayBuffer {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let index = 0; index < binary.length; index++) bytes[index] = binary.charCodeAt(index);
  return bytes.buffer;
}

/** The text of a data block of the page; empty where there is none. */
export function block(name: string): string {
  return document.getElementById(`lipwright-${name}`)?.textContent ?? "";
}
