/** The pairs of the line that is shown, in the order in which they sound. */

import { spanAt, type Span } from "../../shared/spans.ts";
import { byId, h, put } from "../core/dom.ts";
import { nameOf, type Pair, type Session } from "../core/session.ts";
import type { PairSpan } from "../protocol.ts";

/** Of a line with more pairs, only those are listed that are in view. */
const MANY = 200;

interface Hooks {
  open(pair: Pair, time: number): void;
  loop(start: number, end: number): void;
  /** The part of the line that is in view. */
  seen(): { start: number; end: number };
}

export class InLine {
  #session: Session;
  #hooks: Hooks;
  #host = byId("in-line");
  #items: HTMLElement[] = [];
  #notes = h("ul", { class: "notes", "aria-label": "Notes" });
  #noted = "";
  #spans: Span[] = [];
  #first = 0;
  #now = -1;

  constructor(session: Session, hooks: Hooks) {
    this.#session = session;
    this.#hooks = hooks;
    session.on(["line", "cells"], () => this.update());
    session.on(["line", "motion"], () => this.#note());
    this.update();
  }

  /** List the pairs; while nobody looks, nothing is done. */
  update(): void {
    if (this.#host.hidden) return;
    const line = this.#session.line;
    this.#now = -1;
    this.#items = [];
    this.#spans = [];
    if (!line) {
      const words = "Type a line below: the pairs that it is made of are listed here.";
      return put(this.#host, h("p", { class: "empty" }, words));
    }
    const listed = this.#listed(line.pairs);
    this.#first = line.pairs.indexOf(listed[0]);
    this.#spans = listed.map(({ pair, first, boundary }) => ({
      label: pair[0],
      start: first,
      end: boundary,
    }));
    this.#items = listed.map((span, at) => this.#item(span, this.#first + at));
    const few = listed.length < line.pairs.length;
    const note = few ? h("p", { class: "section" }, "The pairs in view of a long line") : null;
    put(this.#host, this.#notes, note, h("ul", { class: "list" }, ...this.#items));
    this.#note();
  }

  /** Another part of the line is in view. */
  turn(): void {
    if ((this.#session.line?.pairs.length ?? 0) > MANY) this.update();
  }

  /** Mark the pair that sounds. */
  mark(time: number): void {
    if (this.#host.hidden || !this.#items.length) return;
    const now = spanAt(this.#spans, time);
    if (now === this.#now) return;
    this.#items[this.#now]?.classList.remove("now");
    this.#items[now]?.classList.add("now");
    if (now >= 0 && document.body.classList.contains("playing"))
      this.#items[now]?.scrollIntoView({ block: "nearest" });
    this.#now = now;
  }

  /** Mark the pair that is open. */
  choose(pair: Pair): void {
    for (const item of this.#items) {
      const own = item.dataset["pair"] === nameOf(pair);
      item.firstElementChild?.setAttribute("aria-current", String(own));
    }
  }

  /** What there is to say about the line: doubts of its times, pairs that stand in. */
  #note(): void {
    const { line, motion } = this.#session;
    const notes = [...new Set([...(line?.notes ?? []), ...(motion.a?.view.notes ?? [])])];
    if (notes.join("\n") === this.#noted) return;
    this.#noted = notes.join("\n");
    put(this.#notes, ...notes.map((note) => h("li", {}, note)));
    this.#notes.hidden = !notes.length;
    const count = h("span", { class: "count warn", title: "notes" }, String(notes.length));
    put(byId("tab-in-line"), "In line", notes.length ? count : null);
  }

  #listed(pairs: PairSpan[]): PairSpan[] {
    if (pairs.length <= MANY) return pairs;
    const { start, end } = this.#hooks.seen();
    return pairs.filter(({ first, last }) => last >= start && first <= end).slice(0, MANY);
  }

  #item({ pair, first, boundary, last }: PairSpan, index: number): HTMLElement {
    const { line, cells, watched } = this.#session;
    const cell = cells.get(nameOf(pair));
    const word = line?.classes[index + 1]?.word || line?.classes[index]?.word || "";
    const state = cell?.overridden ? "override" : cell?.state === "drawn" ? "" : cell?.state;
    const chosen = watched.pair ? nameOf(pair) === nameOf(watched.pair) : false;
    const button = h(
      "button",
      {
        type: "button",
        title: "Click to edit; double-click to loop",
        "aria-current": String(chosen),
        onclick: () => this.#hooks.open(pair, boundary),
        ondblclick: () => this.#hooks.loop(first, last),
      },
      h("span", { class: "pair" }, pair.join(" – ")),
      h("span", { class: "word" }, word),
      state ? h("span", { class: `badge ${state}` }, state) : null,
      h("span", { class: "number" }, first.toFixed(2)),
    );
    return h("li", { "data-pair": nameOf(pair) }, button);
  }
}
