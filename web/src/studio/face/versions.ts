/** A and B: which two versions are compared, and which of them is seen. */

import { byId, h, put } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { Variant } from "../protocol.ts";
import type { Face, Shown } from "./face.ts";

interface Choice {
  words: string;
  variant: Variant;
}

const SIDES: [Shown, string, string][] = [
  ["a", "A", "What is edited now"],
  ["b", "B", "What it is compared with"],
  ["both", "A|B", "Both, side by side"],
];

export class Versions {
  #session: Session;
  #face: Face;
  #choices: Choice[] = [];
  #select = byId<HTMLSelectElement>("other");

  constructor(session: Session, face: Face) {
    this.#session = session;
    this.#face = face;
    for (const [shown, label, words] of SIDES)
      byId("ab").append(
        h(
          "button",
          {
            type: "button",
            "data-shown": shown,
            title: `${words} (X)`,
            "aria-label": words,
            onclick: () => this.show(shown),
          },
          label,
        ),
      );
    this.#select.addEventListener("change", () => this.#choose());
    session.on("hello", () => this.#offer());
    this.#press();
  }

  show(shown: Shown): void {
    this.#face.show(shown);
    const other = shown === "a" ? null : this.#variant();
    if (JSON.stringify(other) !== JSON.stringify(this.#session.watched.other))
      this.#session.watch({ other });
    this.#press();
  }

  /** From A to B and back: a difference is best seen in the same place. */
  toggle(): void {
    if (this.#face.shown === "both") return;
    this.#face.show(this.#face.shown === "a" ? "b" : "a");
    if (!this.#session.watched.other) this.#session.watch({ other: this.#variant() });
    this.#press();
  }

  #variant(): Variant {
    return this.#choices[this.#select.selectedIndex]?.variant ?? { kind: "opened", value: "" };
  }

  #choose(): void {
    if (this.#face.shown === "a") this.#face.show("both");
    this.#session.watch({ other: this.#variant() });
    this.#press();
  }

  #offer(): void {
    const hello = this.#session.hello;
    if (!hello) return;
    const others = (names: string[], kind: NonNullable<Variant["kind"]>, words: string) =>
      names.map((name) => ({ words: `${words} ${name}`, variant: { kind, value: name } }));
    this.#choices = [
      { words: "as it was opened", variant: { kind: "opened", value: "" } },
      { words: "without this line's edits", variant: { kind: "unedited", value: "" } },
      ...others(
        hello.presets.filter((name) => name !== hello.preset),
        "preset",
        "preset",
      ),
      ...others(
        hello.sets.filter((name) => name !== hello.setName),
        "set",
        "set",
      ),
      ...others(hello.characters, "character", "character"),
      ...others(
        hello.engines.filter((name) => name !== "bigram"),
        "engine",
        "engine",
      ),
    ];
    const before = this.#select.selectedIndex;
    put(this.#select, ...this.#choices.map(({ words }) => h("option", {}, words)));
    this.#select.selectedIndex = Math.max(before, 0);
  }

  #press(): void {
    for (const button of byId("ab").querySelectorAll("button"))
      button.ariaPressed = String(button.dataset["shown"] === this.#face.shown);
    this.#select.hidden = this.#face.shown === "a";
  }
}
