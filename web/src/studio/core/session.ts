/** What is open, as the server last said it; and the only place from which it is changed. */

import type { Curves } from "../../shared/curves.ts";
import { Connection } from "./connection.ts";
import { framesOf, unpack } from "./packed.ts";
import type {
  Answer,
  BigramView,
  Cell,
  Change,
  Changed,
  CharacterView,
  FileInfo,
  Hello,
  History,
  LineName,
  LinePart,
  LineView,
  MotionView,
  PeaksView,
  PhoneView,
  PoseInfo,
  Request,
  Rule,
  Watch,
} from "../protocol.ts";

export type Pair = [string, string];
export type Topic =
  | "hello"
  | "line list"
  | "cells"
  | "rules"
  | "files"
  | "history"
  | "pair"
  | "phone"
  | "line"
  | "motion"
  | "peaks"
  | "character"
  | "online"
  | "progress";

/** A motion, its frames ready to be sampled. */
export interface Motion {
  view: MotionView;
  controls: Curves;
  channels: Curves;
}

/** Least and greatest sample of each stretch of a line's sound. */
export interface LinePeaks {
  low: Float32Array;
  high: Float32Array;
  perSecond: number;
}

export const nameOf = ([first, second]: readonly [string, string]) => `${first}-${second}`;

interface Splice<T> {
  at: number;
  gone: number;
  new: T[];
}

/** A line with what became different of it. */
function joined(line: LineView, { type: _, ...part }: LinePart): LineView {
  const spliced = <T>(list: T[], { at, gone, new: items }: Splice<T>) => [
    ...list.slice(0, at),
    ...items,
    ...list.slice(at + gone),
  ];
  return {
    ...line,
    ...part,
    words: spliced(line.words, part.words),
    phones: spliced(line.phones, part.phones),
    classes: spliced(line.classes, part.classes),
    pairs: spliced(line.pairs, part.pairs),
  };
}

export class Session {
  hello: Hello | null = null;
  cells = new Map<string, Cell>();
  rules: Rule[] = [];
  poses: PoseInfo[] = [];
  lines: LineName[] = [];
  files: FileInfo[] = [];
  history: History = { undo: "", redo: "", undoSteps: 0, redoSteps: 0 };
  pair: BigramView | null = null;
  phone: PhoneView | null = null;
  line: LineView | null = null;
  motion: { a: Motion | null; b: Motion | null } = { a: null, b: null };
  character: { a: CharacterView | null; b: CharacterView | null } = { a: null, b: null };
  peaks = new Map<string, LinePeaks>();
  progress: { id: number; share: number; what: string } | null = null;
  /** Where changes of the set go. */
  target: "overrides" | "set" = "overrides";
  readonly connection: Connection;
  /** What the server has, and up to where what is watched has come. */
  #revision = { now: 0, shown: 0 };
  #watched: Watch = { type: "watch", pair: null, phone: "", line: "", stages: [], other: null };
  #asked = false;
  #listeners = new Map<Topic, (() => void)[]>();
  #complain: (error: Error) => void;

  constructor(complain: (error: Error) => void) {
    this.#complain = complain;
    this.connection = new Connection(
      (answer) => this.#hear(answer),
      () => this.#announce("online"),
      () => void this.#begin(),
    );
  }

  on(topics: Topic | Topic[], listener: () => void): void {
    for (const topic of [topics].flat())
      this.#listeners.set(topic, [...(this.#listeners.get(topic) ?? []), listener]);
  }

  get watched(): Readonly<Watch> {
    return this.#watched;
  }

  /** Show something else, besides or instead of what is shown; said to the server once for all. */
  watch(part: Omit<Watch, "type" | "id">): void {
    const before = this.#watched;
    this.#watched = { ...before, ...part };
    if (this.#watched.line !== before.line) {
      this.line = null;
      this.motion = { a: null, b: null };
      this.#announce("line", "motion");
    }
    if (!this.#watched.other && this.motion.b) {
      this.motion.b = null;
      this.#announce("motion");
    }
    if (this.#asked) return;
    this.#asked = true;
    queueMicrotask(() => {
      this.#asked = false;
      if (this.hello) this.connection.ask(this.#watched).catch(this.#complain);
    });
  }

  /** Whether nothing waits for an answer and all that is watched is as the server has it. */
  get settled(): boolean {
    return this.connection.pending === 0 && this.#revision.shown >= this.#revision.now;
  }

  ask<Kind extends Answer>(request: Request): Promise<Kind> {
    return this.connection.ask<Kind>(request);
  }

  /** Change something; what the server refuses is said to the user. */
  async edit(change: Change, merge = ""): Promise<Changed | null> {
    try {
      return await this.ask<Changed>({ type: "edit", change, merge });
    } catch (error) {
      this.#complain(error as Error);
      return null;
    }
  }

  undo(): void {
    if (this.history.undo) this.ask({ type: "undo" }).catch(this.#complain);
  }

  redo(): void {
    if (this.history.redo) this.ask({ type: "redo" }).catch(this.#complain);
  }

  /** The value of a setting of the stages. */
  setting(field: string): number | string | undefined {
    return this.rules.find((rule) => rule.kind === "setting" && rule.field === field)?.value;
  }

  poseNames(): string[] {
    return this.poses.map(({ name }) => name);
  }

  async #begin(): Promise<void> {
    const known = this.hello !== null;
    try {
      await this.ask<Hello>({ type: "start", session: this.hello?.session ?? "" });
    } catch (error) {
      return this.#complain(error as Error);
    }
    if (known) this.connection.repeat();
    this.watch({});
  }

  #hear(answer: Answer): void {
    if (answer.type !== "progress" && answer.id && answer.id === this.progress?.id) {
      this.progress = null;
      this.#announce("progress");
    }
    switch (answer.type) {
      case "hello":
        return this.#greet(answer);
      case "changed":
        return this.#change(answer);
      case "watched":
        this.#revision.shown = answer.revision;
        return;
      case "bigram":
        this.pair = answer;
        return this.#announce("pair");
      case "phone":
        this.phone = answer;
        return this.#announce("phone");
      case "line":
        if (answer.line !== this.#watched.line) return;
        this.line = answer;
        return this.#announce("line");
      case "line part":
        if (answer.line !== this.line?.line) return;
        this.line = joined(this.line, answer);
        return this.#announce("line");
      case "motion":
        if (answer.line !== this.#watched.line) return;
        if (answer.version === "b" && !this.#watched.other) return;
        this.motion[answer.version] = {
          view: answer,
          controls: framesOf(answer.controls),
          channels: framesOf(answer.channels),
        };
        return this.#announce("motion");
      case "peaks":
        return this.#keepPeaks(answer);
      case "character":
        this.character[answer.version] = answer;
        return this.#announce("character");
      case "coverage":
        this.#cells(answer.cells);
        return this.#announce("cells");
      case "saved":
        this.files = answer.files;
        return this.#announce("files");
      case "progress":
        this.progress = answer.share < 1 ? answer : null;
        return this.#announce("progress");
    }
  }

  #greet(hello: Hello): void {
    const first = this.hello === null;
    this.hello = hello;
    this.#revision = { now: hello.revision, shown: -1 };
    this.cells = new Map(hello.cells.map((cell) => [nameOf(cell.pair), cell]));
    this.rules = hello.rules;
    this.poses = hello.poses;
    this.lines = hello.lines;
    this.files = hello.files;
    this.history = hello.history;
    if (first) this.target = hello.target;
    const shown = this.character.a;
    this.character.a = hello.character;
    // What was shown may be another by now: a draft was taken, or a file was read again.
    if (!first) this.watch({});
    this.#announce("hello", "cells", "rules", "line list", "files", "history");
    if (shown?.model !== hello.character.model) this.#announce("character");
  }

  #change(changed: Changed): void {
    this.#revision.now = changed.revision;
    this.history = changed.history;
    this.#cells(changed.cells);
    if (changed.rules) this.rules = changed.rules;
    if (changed.poses) this.poses = changed.poses;
    if (changed.lines) this.lines = changed.lines;
    if (changed.files) this.files = changed.files;
    this.#announce("history");
    if (changed.cells.length) this.#announce("cells");
    if (changed.rules || changed.poses) this.#announce("rules");
    if (changed.files) this.#announce("files");
    if (changed.lines) this.#announce("line list");
  }

  #keepPeaks({ line, peaks, perSecond }: PeaksView): void {
    const values = unpack(peaks);
    const every = (from: number) =>
      Float32Array.from({ length: values.length >> 1 }, (_, at) => values[2 * at + from]);
    this.peaks.set(line, { low: every(0), high: every(1), perSecond });
    this.#announce("peaks");
  }

  #cells(cells: Cell[]): void {
    for (const cell of cells) this.cells.set(nameOf(cell.pair), cell);
  }

  #announce(...topics: Topic[]): void {
    for (const topic of topics) for (const act of this.#listeners.get(topic) ?? []) act();
  }
}
