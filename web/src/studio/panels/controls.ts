/** The controls of the line: shown or hidden, which one is looked into, and their values now. */

import { sample } from "../../shared/curves.ts";
import { stroke } from "../../shared/palette.ts";
import { byId, h, put, swatch, write } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { Looks } from "../line/canvas.ts";

interface Row {
  item: HTMLElement;
  tick: HTMLInputElement;
  bar: HTMLElement;
  value: HTMLElement;
}

export class Controls {
  #session: Session;
  #looks: Looks;
  #rows: Row[] = [];
  #changed: () => void;
  #dark: () => boolean;
  #names = "";

  constructor(session: Session, looks: Looks, changed: () => void, dark: () => boolean) {
    this.#session = session;
    this.#looks = looks;
    this.#changed = changed;
    this.#dark = dark;
    session.on(["motion", "hello"], () => this.make());
    this.make();
  }

  make(again = false): void {
    const names = this.#session.motion.a?.controls.names ?? this.#session.poseNames();
    const key = names.join("\n");
    if (key === this.#names && !again) return;
    this.#names = key;
    this.#rows = names.map((name, index) => this.#row(name, index));
    const all = h(
      "div",
      { class: "all" },
      h(
        "button",
        { type: "button", class: "quiet small", onclick: () => this.all() },
        "All or none",
      ),
      h(
        "button",
        { type: "button", class: "quiet small", onclick: () => this.solo() },
        "Only the chosen one",
      ),
    );
    put(byId("controls"), ...this.#rows.map(({ item }) => item), names.length ? all : null);
    this.update();
  }

  /** Show all, or none if all are shown. */
  all(): void {
    const { hidden } = this.#looks;
    if (hidden.size) hidden.clear();
    else for (const name of this.#names.split("\n")) hidden.add(name);
    this.update();
    this.#changed();
  }

  /** Show the chosen one alone; again, all. */
  solo(): void {
    const { hidden, control } = this.#looks;
    const others = this.#names.split("\n").filter((name) => name !== control);
    const alone = others.every((name) => hidden.has(name));
    hidden.clear();
    if (!alone) for (const name of others) hidden.add(name);
    this.update();
    this.#changed();
  }

  choose(name: string): void {
    this.#looks.control = name;
    this.#looks.hidden.delete(name);
    this.update();
    this.#changed();
  }

  step(way: 1 | -1): void {
    const names = this.#names.split("\n");
    const next = names[names.indexOf(this.#looks.control) + way];
    if (next) this.choose(next);
  }

  update(): void {
    this.#names.split("\n").forEach((name, index) => {
      const row = this.#rows[index];
      if (!row) return;
      row.tick.checked = !this.#looks.hidden.has(name);
      row.item.classList.toggle("active", name === this.#looks.control);
    });
  }

  /** Write the values of an instant. */
  at(time: number): void {
    const controls = this.#session.motion.a?.controls;
    if (byId("controls").hidden) return;
    const values = controls ? sample(controls, time) : new Float32Array(this.#rows.length);
    values.forEach((value, index) => {
      const row = this.#rows[index];
      if (!row) return;
      write(row.value, value.toFixed(2));
      row.bar.style.transform = `scaleX(${Math.min(Math.max(value, 0), 1)})`;
    });
  }

  #row(name: string, index: number): Row {
    const { colour, dash } = stroke(index, this.#dark());
    const tick = h("input", { type: "checkbox", "aria-label": `Show ${name}` });
    tick.addEventListener("change", () => {
      if (tick.checked) this.#looks.hidden.delete(name);
      else this.#looks.hidden.add(name);
      this.#changed();
    });
    const bar = h("span");
    bar.style.background = colour;
    const value = h("span", { class: "value" });
    const button = h(
      "button",
      { type: "button", title: `Look into ${name}`, onclick: () => this.choose(name) },
      name,
    );
    const item = h(
      "div",
      { class: "control" },
      tick,
      swatch(colour, dash),
      button,
      h("span", { class: "bar-track" }, bar),
      value,
    );
    return { item, tick, bar, value };
  }
}
