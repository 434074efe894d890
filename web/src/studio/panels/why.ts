/** Why a control has its value: from what is seen back to the key that somebody drew. */

import { byId, h, put } from "../core/dom.ts";
import { nameOf, type Pair, type Session } from "../core/session.ts";
import { STAGES, stageStroke, type StageName } from "../line/palette.ts";
import type { OriginView, ReasonView, WhyView } from "../protocol.ts";

interface Hooks {
  open(pair: Pair, control: string, keys: [number, number][]): void;
  shown(): void;
  dark(): boolean;
  figures(): boolean;
  complain(error: Error): void;
}

const two = (value: number) => value.toFixed(2);

export class WhyPanel {
  #session: Session;
  #hooks: Hooks;
  #asked = 0;
  view: WhyView | null = null;

  constructor(session: Session, hooks: Hooks) {
    this.#session = session;
    this.#hooks = hooks;
    session.on("motion", () => void this.again());
    session.on("line", () => {
      if (this.view && this.view.line !== session.line?.line) this.#show(null);
    });
    this.#show(null);
  }

  async ask(control: string, time: number): Promise<void> {
    const line = this.#session.watched.line;
    if (!line) return;
    const number = ++this.#asked;
    try {
      const view = await this.#session.ask<WhyView>({ type: "why", line, control, time });
      if (number === this.#asked) this.#show(view);
    } catch (error) {
      this.#hooks.complain(error as Error);
    }
  }

  /** What was asked is told anew, when the line has changed. */
  async again(): Promise<void> {
    const view = this.view;
    if (view && !byId("why").hidden && view.line === this.#session.watched.line)
      await this.ask(view.control, view.time);
  }

  #show(view: WhyView | null): void {
    this.view = view;
    const host = byId("why");
    if (!view) {
      const words =
        "Click any curve in the line: this tells which pair drew it, and what each stage made of it.";
      return put(host, h("p", { class: "empty" }, words));
    }
    const where = [
      `at ${view.time.toFixed(3)} s, in /${view.phone}/`,
      view.word && `of “${view.word}”`,
    ];
    const rest = view.origins.length || view.reasons.length;
    put(
      host,
      h(
        "div",
        { class: "why-value" },
        h("strong", {}, `${view.control} ${two(view.value)}`),
        ` ${where.filter(Boolean).join(" ")}`,
      ),
      h(
        "ol",
        { class: "chain" },
        ...view.origins.map((origin, index) => this.#origin(view, origin, index === 0)),
        ...view.reasons.map((reason) => this.#reason(reason)),
        ...view.edits.map((edit) => h("li", {}, h("div", { class: "what" }, `edit: ${edit}`))),
        rest ? null : h("li", {}, "no pair has a curve of it here"),
      ),
      view.alone !== null && Math.abs(view.alone - view.value) > 0.001
        ? h("p", { class: "hint" }, `Without overrides it would be ${two(view.alone)}.`)
        : null,
    );
    this.#hooks.shown();
  }

  #origin(view: WhyView, origin: OriginView, won: boolean): HTMLElement {
    const { pair, value, source, keys, override, own, start, end } = origin;
    const open = h(
      "button",
      {
        type: "button",
        title: `Open ${nameOf(pair)} in the curve editor`,
        onclick: () => this.#hooks.open(pair, view.control, keys),
      },
      pair.join(" – "),
    );
    const between = keys.map(([time, weight]) => `(${time}, ${weight})`).join(" and ");
    const said = [
      override || source,
      keys.length ? `between keys ${between}` : "",
      `${start.toFixed(2)} to ${end.toFixed(2)} s`,
      own !== null ? `the set's own would be ${two(own)}` : "",
    ];
    const item = h(
      "li",
      {},
      h("div", { class: "what" }, won ? "drawn by" : "below it", open, h("span", {}, two(value))),
      h("small", {}, said.filter(Boolean).join(" · ")),
    );
    item.style.setProperty("--mark", won ? this.#colour("placed") : "var(--line)");
    return item;
  }

  #reason({ stage, before, after, text }: ReasonView): HTMLElement {
    const item = h(
      "li",
      {},
      h("div", { class: "what" }, stage, h("span", {}, `${two(before)} → ${two(after)}`)),
      h("small", {}, text),
    );
    if (STAGES.includes(stage as StageName))
      item.style.setProperty("--mark", this.#colour(stage as StageName));
    return item;
  }

  #colour(stage: StageName): string {
    return stageStroke(stage, this.#hooks.dark(), this.#hooks.figures()).colour;
  }
}
