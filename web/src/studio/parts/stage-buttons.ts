/** The stages that are switched on, and the tools of the line's picture. */

import { byId, h, iconButton, put, swatch } from "../core/dom.ts";
import { isDark } from "../core/theme.ts";
import type { LineCanvas, Looks } from "../line/canvas.ts";
import { ABOUT, STAGES, stageStroke, type StageName } from "../line/palette.ts";

export class StageButtons {
  #looks: Looks;
  #changed: () => void;

  constructor(looks: Looks, canvas: LineCanvas, changed: () => void) {
    this.#looks = looks;
    this.#changed = changed;
    this.show();
    put(
      byId("view-tools"),
      iconButton("lanes", "Curves apart, or together", () => this.toggleLanes(), "G"),
      iconButton("minus", "Zoom out", () => canvas.zoom(1.25), "−"),
      iconButton("plus", "Zoom in", () => canvas.zoom(0.8), "+"),
      iconButton("fit", "Show all of the line", () => canvas.fit(), "0"),
    );
  }

  show(): void {
    const buttons = STAGES.map((name) => {
      const { colour, dash } = stageStroke(name, isDark(), this.#looks.figures);
      const words = `${name}: ${ABOUT[name]}`;
      return this.#button(words, this.#looks.on.has(name), () => this.toggle(name), [
        swatch(colour, dash),
        name,
      ]);
    });
    const words = "Colours of the publication's figures, or ones that all eyes tell apart";
    const figures = this.#button(
      words,
      this.#looks.figures,
      () => {
        this.#looks.figures = !this.#looks.figures;
        this.show();
        this.#changed();
      },
      ["◐"],
    );
    figures.ariaLabel = "Colours of the publication";
    put(byId("stages"), ...buttons, figures);
  }

  toggle(name: StageName): void {
    const { on } = this.#looks;
    if (!on.delete(name)) on.add(name);
    this.show();
    this.#changed();
  }

  toggleLanes(): void {
    this.#looks.apart = !this.#looks.apart;
    this.#changed();
  }

  /** The stages that the server must send. */
  get needed(): StageName[] {
    const { on } = this.#looks;
    // A stitched curve is shown over the pieces that it is made of.
    return STAGES.filter((name) => on.has(name) || (name === "placed" && on.has("stitched")));
  }

  #button(
    title: string,
    pressed: boolean,
    act: () => void,
    children: (Node | string)[],
  ): HTMLButtonElement {
    const attributes = { type: "button", title, "aria-pressed": String(pressed), onclick: act };
    return h("button", attributes, ...children);
  }
}
