/** Tabs: a click, arrows, or what shows something, opens the panel. */

import { byId } from "../core/dom.ts";

export class Tabs {
  #tabs: HTMLButtonElement[];
  #shown: (panel: string) => void;
  open = "";

  constructor(list: Element, first: string, shown: (panel: string) => void = () => undefined) {
    this.#shown = shown;
    this.#tabs = [...list.querySelectorAll<HTMLButtonElement>('[role="tab"]')];
    for (const tab of this.#tabs)
      tab.addEventListener("click", () => this.show(tab.getAttribute("aria-controls") ?? ""));
    list
      .querySelector('[role="tablist"]')
      ?.addEventListener("keydown", (event) => this.#key(event as KeyboardEvent));
    this.show(first);
  }

  show(panel: string): void {
    this.open = panel;
    for (const tab of this.#tabs) {
      const name = tab.getAttribute("aria-controls") ?? "";
      tab.ariaSelected = String(name === panel);
      tab.tabIndex = name === panel ? 0 : -1;
      byId(name).hidden = name !== panel;
    }
    this.#shown(panel);
  }

  #key(event: KeyboardEvent): void {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!way) return;
    const at = this.#tabs.findIndex((tab) => tab.getAttribute("aria-controls") === this.open);
    const next = this.#tabs[(at + way + this.#tabs.length) % this.#tabs.length];
    next.focus();
    next.click();
    event.preventDefault();
    event.stopPropagation();
  }
}
