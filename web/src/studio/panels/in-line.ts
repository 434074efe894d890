/** The pairs of the line that is shown, in the order in which they sound. */

import { spanAt } from "../../shared/spans.ts";
import { byId, h, put } from "../core/dom.ts";
import { nameOf, type Pair, type Session } from "../core/session.ts";

export class InLine {
  #session: Session;
  #open: (pair: Pair, time: number) => void;
  #loop: (start: number, end: number) => void;
  #host = byId("in-line");
  #items: HTMLElement[] = [];
  #now = -1;

  constructor(
    session: Session,
    open: (pair: Pair, time: number) => void,
    loop: (start: number, end: number) => void,
  ) {
    this.#session = session;
    this.#open = open;
    this.#loop = loop;
    session.on(["line", "cells"], () => this.update());
    this.update();
  }

  update(): void {
    const line = this.#session.line;
    this.#now = -1;
    if (!line) {
      this.#items = [];
      const words = "Type a line below: the pairs that it is made of are listed here.";
      return put(this.#host, h("p", { class: "empty" }, words));
    }
    this.#items = line.pairs.map(({ pair, first, boundary, last }, index) => {
      const cell = this.#session.cells.get(nameOf(pair));
      const word = line.classes[index + 1]?.word || line.classes[index]?.word || "";
      const state = cell?.overridden ? "override" : cell?.state === "drawn" ? "" : cell?.state;
      const chosen = nameOf(pair) === nameOf((this.#session.watched.pair ?? ["", ""]) as Pair);
      return h(
        "li",
        { "data-pair": nameOf(pair) },
        h(
          "button",
          {
            type: "button",
            "aria-current": chosen,
            title: "Click to edit; double-click to loop",
            onclick: () => this.#open(pair, boundary),
            ondblclick: () => this.#loop(first, last),
          },
          h("span", { class: "pair" }, pair.join(" – ")),
          h("span", { class: "word" }, word),
          state ? h("span", { class: `badge ${state}` }, state) : null,
          h("span", { class: "number" }, first.toFixed(2)),
        ),
      );
    });
    put(this.#host, h("ul", { class: "list" }, ...this.#items));
  }

  /** Mark the pair that sounds, and that which is open. */
  mark(time: number): void {
    const line = this.#session.line;
    if (!line || this.#host.hidden) return;
    const spans = line.pairs.map(({ first, boundary, pair }) => ({
      label: pair[0],
      start: first,
      end: boundary,
    }));
    const now = spanAt(spans, time);
    if (now === this.#now) return;
    this.#items[this.#now]?.classList.remove("now");
    this.#items[now]?.classList.add("now");
    if (now >= 0 && document.body.classList.contains("playing"))
      this.#items[now]?.scrollIntoView({ block: "nearest" });
    this.#now = now;
  }

  choose(pair: Pair | null): void {
    const name = pair ? nameOf(pair) : "";
    for (const item of this.#items)
      item.firstElementChild?.setAttribute("aria-current", String(item.dataset["pair"] === name));
  }
}
