/** The poses beside the curve editor: ticked where the pair has a curve, chosen where it is edited. */

import { stroke } from "../../shared/palette.ts";
import { h, put, swatch, write } from "../core/dom.ts";

export interface PoseState {
  name: string;
  on: boolean;
  active: boolean;
  peak: number;
  /** Whether the set beneath has another curve. */
  differs: boolean;
}

interface Row {
  item: HTMLLIElement;
  tick: HTMLInputElement;
  button: HTMLButtonElement;
  peak: HTMLElement;
}

export class PoseList {
  #list: HTMLElement;
  #rows = new Map<string, Row>();
  #tick: (name: string, on: boolean) => void;
  #choose: (name: string) => void;

  constructor(
    list: HTMLElement,
    tick: (name: string, on: boolean) => void,
    choose: (name: string) => void,
  ) {
    this.#list = list;
    this.#tick = tick;
    this.#choose = choose;
  }

  update(states: PoseState[], dark: boolean): void {
    const names = states.map(({ name }) => name).join("\n");
    const theme = `${names}${dark}`;
    if (this.#list.dataset["made"] !== theme) this.#make(states, dark);
    this.#list.dataset["made"] = theme;
    for (const { name, on, active, peak, differs } of states) {
      const row = this.#rows.get(name) as Row;
      row.tick.checked = on;
      row.item.classList.toggle("off", !on);
      row.item.classList.toggle("active", active);
      row.item.classList.toggle("differs", differs);
      row.button.ariaPressed = String(active);
      write(row.peak, on ? peak.toFixed(2) : "");
    }
  }

  #make(states: PoseState[], dark: boolean): void {
    this.#rows.clear();
    const items = states.map(({ name }, index) => {
      const { colour, dash } = stroke(index, dark);
      const tick = h("input", {
        type: "checkbox",
        "aria-label": `${name} has a curve`,
        title: `Give ${name} a curve, or take it out`,
      });
      tick.addEventListener("change", () => this.#tick(name, tick.checked));
      const peak = h("span", { class: "peak" });
      const button = h(
        "button",
        { type: "button", title: `Edit ${name}`, onclick: () => this.#choose(name) },
        swatch(colour, dash),
        h("span", { class: "name" }, name),
        peak,
      );
      const item = h("li", {}, tick, button);
      this.#rows.set(name, { item, tick, button, peak });
      return item;
    });
    put(this.#list, ...items);
  }
}
