/** What to draw first: the pairs that a text or all lines need, and those corrected most often. */

import { byId, h, put } from "../core/dom.ts";
import { nameOf, type Pair, type Session } from "../core/session.ts";
import type { CoverageView, NeedView } from "../protocol.ts";

const SHOWN = 60;
const percent = (share: number) => `${(100 * share).toFixed(share < 0.1 ? 1 : 0)} %`;

export class Coverage {
  #session: Session;
  #open: (pair: Pair) => void;
  #complain: (error: Error) => void;
  #answer = h("div");
  #text = h("input", {
    "aria-label": "Text to count",
    placeholder: "A text, or empty for this line",
  });

  constructor(session: Session, open: (pair: Pair) => void, complain: (error: Error) => void) {
    this.#session = session;
    this.#open = open;
    this.#complain = complain;
    const form = h("form", { class: "ask" }, this.#text, h("button", { type: "submit" }, "Count"));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.ask(false);
    });
    const all = h(
      "button",
      { type: "button", onclick: () => void this.ask(true) },
      "All that is open",
    );
    form.append(all);
    const hint = "Counts which pairs are needed, colours the table, and lists what to draw first.";
    put(this.#answer, h("p", { class: "empty" }, hint));
    put(byId("coverage"), form, this.#answer);
  }

  async ask(every: boolean): Promise<void> {
    const text = this.#text.value.trim() || (every ? "" : (this.#session.line?.text ?? ""));
    try {
      const ask = { type: "coverage" as const, text, every };
      this.#show(await this.#session.ask<CoverageView>(ask));
    } catch (error) {
      this.#complain(error as Error);
    }
  }

  #show(view: CoverageView): void {
    const share = h(
      "p",
      { class: "section" },
      `${percent(view.share)} of what ${view.source} needs is drawn`,
    );
    const missing = view.missing.slice(0, SHOWN);
    const needed = view.needed.slice(0, SHOWN);
    const most = Math.max(1e-9, ...view.needed.map((need) => need.share));
    const corrected = view.edited.map(({ pair, edits, lines }) =>
      this.#row(pair, `${edits} edits in ${lines} ${lines === 1 ? "line" : "lines"}`, null, ""),
    );
    put(
      this.#answer,
      share,
      ...view.notes.map((note) => h("p", { class: "section" }, note)),
      ...listed(
        "To draw, worst first",
        missing.map((need) => this.#item(need, most, true)),
      ),
      ...listed("Corrected most often in lines", corrected),
      ...listed(
        "Needed, most first",
        needed.map((need) => this.#item(need, most, false)),
      ),
    );
  }

  #item({ pair, share, word, covered, state }: NeedView, most: number, gain: boolean): HTMLElement {
    const words = gain ? `${word} → ${percent(covered)}` : word;
    const mark = state === "drawn" ? "" : state;
    return this.#row(pair, words, share / most, mark || percent(share));
  }

  #row(pair: Pair, words: string, share: number | null, number: string): HTMLElement {
    const meter = h("span", { class: "meter" }, h("span"));
    (meter.firstElementChild as HTMLElement).style.width = `${100 * (share ?? 0)}%`;
    return h(
      "li",
      { "data-pair": nameOf(pair) },
      h(
        "button",
        { type: "button", onclick: () => this.#open(pair) },
        h("span", { class: "pair" }, pair.join(" – ")),
        h("span", { class: "word" }, words),
        share === null ? null : meter,
        h("span", { class: "number" }, number),
      ),
    );
  }
}

/** A heading and its list, or nothing. */
function listed(title: string, items: HTMLElement[]): HTMLElement[] {
  if (!items.length) return [];
  return [h("p", { class: "section" }, title), h("ul", { class: "list" }, ...items)];
}
