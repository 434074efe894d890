/** Poses by hand: what the face looks like with some of them at some weight. */

import { stroke } from "../../shared/palette.ts";
import { byId, h, put, swatch } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { PoseView } from "../protocol.ts";

export class Sliders {
  weights: Record<string, number> = {};
  #session: Session;
  #shown: (channels: Record<string, number> | null) => void;
  #dark: () => boolean;
  #complain: (error: Error) => void;
  #busy = false;
  #again = false;

  constructor(
    session: Session,
    shown: (channels: Record<string, number> | null) => void,
    dark: () => boolean,
    complain: (error: Error) => void,
  ) {
    this.#session = session;
    this.#shown = shown;
    this.#dark = dark;
    this.#complain = complain;
    session.on("hello", () => this.make());
    session.on("character", () => {
      if (Object.keys(this.weights).length) void this.#send();
    });
  }

  make(): void {
    const rows = this.#session.poseNames().map((name, index) => {
      const { colour, dash } = stroke(index, this.#dark());
      const said = h("output", {}, (this.weights[name] ?? 0).toFixed(2));
      const input = h("input", {
        type: "range",
        min: 0,
        max: 1,
        step: 0.01,
        value: this.weights[name] ?? 0,
        "aria-label": name,
      });
      input.addEventListener("input", () => {
        this.weights[name] = Number(input.value);
        said.textContent = Number(input.value).toFixed(2);
        void this.#send();
      });
      return h("div", { class: "slider" }, swatch(colour, dash), h("span", {}, name), input, said);
    });
    const back = h(
      "button",
      { type: "button", class: "small quiet", onclick: () => this.clear() },
      "Back to the line",
    );
    put(
      byId("sliders"),
      h("p", { class: "hint" }, "The face holds these poses until the line plays again. ", back),
      ...rows,
    );
  }

  /** Let the face follow the line again. */
  clear(): void {
    if (!Object.keys(this.weights).length) return;
    this.weights = {};
    this.#shown(null);
    this.make();
  }

  async #send(): Promise<void> {
    if (this.#busy) {
      this.#again = true;
      return;
    }
    this.#busy = true;
    try {
      const weights = { ...this.weights };
      const view = await this.#session.ask<PoseView>({ type: "pose", weights });
      if (Object.keys(this.weights).length) this.#shown(view.channels);
    } catch (error) {
      this.#complain(error as Error);
    }
    this.#busy = false;
    if (!this.#again) return;
    this.#again = false;
    void this.#send();
  }
}
