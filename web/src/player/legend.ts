/** The list of controls: colour, name, value at the playhead; pressed, a curve is shown. */

import { peaks, sample, type Curves } from "../shared/curves.ts";
import { stroke } from "../shared/palette.ts";
import type { Shown } from "../shared/paint.ts";
import type { Timeline } from "./timeline.ts";

/** A control that stays below this all the time is listed, but held back. */
const STILL = 0.005;

export class Legend {
  #controls: Curves;
  #shown: Shown;
  #timeline: Timeline;
  #all: HTMLElement;
  #rows: { button: HTMLButtonElement; value: HTMLElement; bar: HTMLElement; line: SVGElement }[] =
    [];

  constructor(
    list: HTMLElement,
    all: HTMLElement,
    controls: Curves,
    shown: Shown,
    timeline: Timeline,
  ) {
    this.#all = all;
    this.#controls = controls;
    this.#shown = shown;
    this.#timeline = timeline;
    const highest = peaks(controls);
    controls.names.forEach((name, index) => {
      const row = this.#row(name, index, highest[index] < STILL);
      const item = document.createElement("li");
      item.append(row.button);
      list.append(item);
      this.#rows.push(row);
    });
    this.restyle();
  }

  /** Show all curves, or none if all are shown. */
  toggleAll(): void {
    const { hidden } = this.#shown;
    if (hidden.size) hidden.clear();
    else this.#controls.names.forEach((_, index) => hidden.add(index));
    this.#press();
  }

  restyle(): void {
    const dark = getComputedStyle(document.body).getPropertyValue("--dark").trim() === "1";
    this.#rows.forEach(({ bar, line }, index) => {
      const { colour, dash } = stroke(index, dark);
      bar.style.background = colour;
      line.setAttribute("stroke", colour);
      line.setAttribute("stroke-dasharray", dash.join(" "));
    });
  }

  update(time: number): void {
    sample(this.#controls, time).forEach((value, index) => {
      const row = this.#rows[index];
      row.value.textContent = value.toFixed(2);
      row.bar.style.transform = `scaleX(${Math.min(Math.max(value, 0), 1)})`;
    });
  }

  #row(name: string, index: number, flat: boolean) {
    const button = document.createElement("button");
    button.type = "button";
    button.classList.toggle("flat", flat);
    button.title = flat ? `${name} (stays at zero)` : name;
    const drawing = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    drawing.setAttribute("aria-hidden", "true");
    drawing.setAttribute("viewBox", "0 0 18 4");
    const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
    line.setAttribute("d", "M0 2h18");
    line.setAttribute("stroke-width", "3");
    drawing.append(line);
    const part = (kind: string) => {
      const element = document.createElement("span");
      element.className = kind;
      return element;
    };
    const [label, value, bar, fill] = [part("name"), part("value"), part("bar"), part("fill")];
    label.textContent = name;
    bar.append(fill);
    button.append(drawing, label, value, bar);
    button.addEventListener("click", () => {
      const { hidden } = this.#shown;
      if (!hidden.delete(index)) hidden.add(index);
      this.#press();
    });
    const highlight = (on: boolean) => () => {
      this.#shown.highlighted = on && !this.#shown.hidden.has(index) ? index : null;
      this.#timeline.refresh();
    };
    button.addEventListener("pointerenter", highlight(true));
    button.addEventListener("pointerleave", highlight(false));
    button.addEventListener("focus", highlight(true));
    button.addEventListener("blur", highlight(false));
    button.ariaPressed = "true";
    return { button, value, bar: fill, line };
  }

  #press(): void {
    this.#rows.forEach(({ button }, index) => {
      button.ariaPressed = String(!this.#shown.hidden.has(index));
    });
    this.#all.textContent = this.#shown.hidden.size ? "Show all" : "Hide all";
    this.#timeline.refresh();
  }
}
