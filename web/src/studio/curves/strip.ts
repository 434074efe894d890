/** The keys of the active curve as numbers: to type, and for those who do not see the picture. */

import { h, put, write } from "../core/dom.ts";
import type { CurveEditor } from "./editor.ts";
import { isHeld } from "./keys.ts";

interface Column {
  cell: HTMLElement;
  time: HTMLInputElement;
  value: HTMLInputElement;
}

export class KeyStrip {
  #host: HTMLElement;
  #editor: CurveEditor;
  #columns: Column[] = [];
  #title = h("span", { class: "strip-title" });
  #list = h("div", { class: "strip-keys", role: "list" });

  constructor(host: HTMLElement, editor: CurveEditor) {
    this.#host = host;
    this.#editor = editor;
    put(host, this.#title, this.#list);
  }

  update(): void {
    const { active, curves, chosen, domain } = this.#editor;
    const keys = curves[active] ?? [];
    const title = keys.length
      ? `${active}: ${keys.length} keys`
      : `${active} has no curve: tick it`;
    write(this.#title, active ? title : "");
    if (this.#columns.length !== keys.length) this.#make(keys.length);
    keys.forEach(([time, value], index) => {
      const { cell, time: first, value: second } = this.#columns[index];
      cell.classList.toggle("chosen", chosen.get(active)?.has(index) ?? false);
      set(first, time);
      set(second, value);
      second.disabled = isHeld(keys, index, domain);
    });
  }

  /** Put the cursor into the time of the first chosen key. */
  focus(): void {
    const [index] = this.#editor.chosen.get(this.#editor.active) ?? [0];
    this.#columns[index]?.time.focus();
    this.#columns[index]?.time.select();
  }

  #make(count: number): void {
    this.#columns = Array.from({ length: count }, (_, index) => this.#column(index));
    put(this.#list, ...this.#columns.map(({ cell }) => cell));
    this.#host.hidden = count === 0 && !this.#editor.active;
  }

  #column(index: number): Column {
    const field = (name: string) =>
      h("input", {
        type: "text",
        inputmode: "decimal",
        spellcheck: "false",
        "aria-label": `${name} of key ${index + 1}`,
        onfocus: () => this.#editor.choose(this.#editor.active, [index]),
      });
    const [time, value] = [field("time"), field("weight")];
    for (const input of [time, value]) {
      input.addEventListener("change", () => this.#type(index, time, value));
      input.addEventListener("keydown", (event) => this.#key(event, index, input));
    }
    const cell = h("div", { class: "strip-key", role: "listitem" }, time, value);
    return { cell, time, value };
  }

  #type(index: number, time: HTMLInputElement, value: HTMLInputElement): void {
    const keys = this.#editor.curves[this.#editor.active] ?? [];
    const number = (input: HTMLInputElement, otherwise: number) => {
      const typed = Number(input.value.replace(",", "."));
      return input.value.trim() && Number.isFinite(typed) ? typed : otherwise;
    };
    const [was, weight] = keys[index];
    this.#editor.place(index, [number(time, was), number(value, weight)]);
    this.update();
  }

  #key(event: KeyboardEvent, index: number, input: HTMLInputElement): void {
    if (event.key === "Escape") {
      this.update();
      this.#editor.canvas.focus();
    } else if (event.key === "Enter") {
      input.dispatchEvent(new Event("change"));
      this.#editor.canvas.focus();
    } else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      const by = (event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 0.1 : 0.01);
      const { time, value } = this.#columns[index];
      const was = Number(input.value);
      input.value = String(Math.round((was + by) * 1000) / 1000);
      this.#type(index, time, value);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

/** Write a number, unless something else is being typed there. */
function set(input: HTMLInputElement, value: number): void {
  const text = String(Math.round(value * 1000) / 1000);
  if (input.dataset["shown"] === text && document.activeElement === input) return;
  input.dataset["shown"] = text;
  if (input.value !== text) input.value = text;
}
