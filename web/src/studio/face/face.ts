/** The face, or two of them: in time with the line, or holding poses that are tried. */

import { sample, type Curves } from "../../shared/curves.ts";
import { blink } from "../../shared/idle.ts";
import type { Model, Turn } from "../../shared/model.ts";
import { drawsInSoftware } from "../../shared/software.ts";
import type { Stage } from "../../shared/stage.ts";
import { VIEWS } from "../../shared/views.ts";
import { byId, h, write } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { CharacterView } from "../protocol.ts";

const LIDS = ["eyeBlinkLeft", "eyeBlinkRight"];
const SHORT: Record<string, string> = {
  front: "Front",
  "three-quarter": "¾",
  side: "Side",
  mouth: "Lips",
  "mouth-side": "Lips ¾",
};

export type Shown = "a" | "b" | "both";

/** All that draws in space comes after the page is seen: it is most of what is to be read. */
const three = () => import("./space.ts");

/** One canvas with one character on it. */
class Head {
  readonly canvas: HTMLCanvasElement;
  stage: Stage | null = null;
  model: Model | null = null;
  address = "";
  #driven: string[] = [];

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
  }

  async load(character: CharacterView, glb: ArrayBuffer, seen: string): Promise<void> {
    const turns: Record<string, Turn> = {};
    for (const { channel, node, axis, degrees } of character.joints)
      turns[channel] = { node, axis, degrees };
    const { loadModel, Stage } = await three();
    const model = await loadModel(glb, character.backwards, turns);
    this.stage?.dispose();
    // A canvas keeps the context that it has: another model begins on a new one.
    this.model = model;
    const used = character.known.length ? character.known : model.names;
    this.stage = new Stage(this.canvas, model, used, drawsInSoftware());
    this.stage.setView(seen);
    this.#driven = [];
  }

  /** Hold the channels of an instant; what no channel drives is at rest. */
  hold(names: string[], values: ArrayLike<number>, lids: number): void {
    const { model } = this;
    if (!model) return;
    for (const name of this.#driven) if (!names.includes(name)) model.set(name, 0);
    for (let at = 0; at < names.length; at++) model.set(names[at], values[at]);
    for (const lid of LIDS) if (!names.includes(lid)) model.set(lid, lids);
    this.#driven = names;
  }
}

export class Face {
  shown: Shown = "a";
  #tried: Record<string, number> | null = null;
  #idle = true;
  #stale = true;
  #drawn = Number.NaN;
  #session: Session;
  #heads: { a: Head; b: Head };
  #box = byId("stage");
  #listeners: (() => void)[] = [];
  #complain: (error: Error) => void;
  #models = new Map<string, Promise<ArrayBuffer>>();
  #following = false;
  #ready: (() => void) | null = null;
  readonly ready = new Promise<void>((resolve) => (this.#ready = resolve));

  constructor(session: Session, complain: (error: Error) => void) {
    this.#session = session;
    this.#complain = complain;
    this.#heads = {
      a: new Head(byId<HTMLCanvasElement>("head-a")),
      b: new Head(byId<HTMLCanvasElement>("head-b")),
    };
    session.on("character", () => void this.#load());
    session.on("motion", () => void this.#load());
    new ResizeObserver(() => this.#place()).observe(this.#box);
    this.#views();
    void this.#load();
  }

  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  /** Call `listener` when a face is clicked, rather than turned. */
  onClick(listener: () => void): void {
    for (const { canvas } of Object.values(this.#heads)) {
      let from = { x: 0, y: 0 };
      canvas.addEventListener("pointerdown", ({ x, y }) => (from = { x, y }));
      canvas.addEventListener("click", ({ x, y }) => {
        if (Math.hypot(x - from.x, y - from.y) < 4) listener();
      });
    }
  }

  get stage(): Stage | null {
    return this.#heads[this.shown === "b" ? "b" : "a"].stage;
  }

  get model(): Model | null {
    return this.#heads[this.shown === "b" ? "b" : "a"].model;
  }

  show(shown: Shown): void {
    this.shown = shown;
    void this.#load();
    this.#place();
    this.#announce();
  }

  setView(name: string, gliding = true): void {
    for (const { stage } of Object.values(this.#heads)) stage?.setView(name, gliding);
  }

  /** Channels that are held instead of the line's. */
  set tried(channels: Record<string, number> | null) {
    this.#tried = channels;
    this.#announce();
  }

  get idle(): boolean {
    return this.#idle;
  }

  /** Whether the eyes blink of themselves. */
  set idle(on: boolean) {
    this.#idle = on;
    this.#announce();
  }

  /** Draw an instant, if it looks new; returns whether the camera still moves of itself. */
  draw(time: number): boolean {
    if (!this.#stale && time === this.#drawn) return false;
    this.#stale = false;
    this.#drawn = time;
    let moving = false;
    for (const version of this.#versions()) {
      const head = this.#heads[version];
      const channels = this.#channels(version);
      const lids = this.#idle && !this.#tried ? blink(time) : 0;
      if (this.#tried) head.hold(Object.keys(this.#tried), Object.values(this.#tried), 0);
      else if (channels) head.hold(channels.names, sample(channels, time), lids);
      else head.hold([], [], lids);
      moving = (head.stage?.draw() ?? false) || moving;
    }
    this.#stale ||= moving;
    return moving;
  }

  #channels(version: "a" | "b"): Curves | null {
    return this.#session.motion[version]?.channels ?? null;
  }

  #versions(): ("a" | "b")[] {
    return this.shown === "both" ? ["a", "b"] : [this.shown];
  }

  /** The second version has the same model, unless another character was sent for it. */
  #character(version: "a" | "b"): CharacterView | null {
    const { a, b } = this.#session.character;
    const own = this.#session.watched.other?.kind === "character" ? b : a;
    return version === "a" ? a : own;
  }

  async #load(): Promise<void> {
    for (const version of this.#versions()) {
      const view = this.#character(version);
      const head = this.#heads[version];
      if (!view || head.address === view.model) continue;
      head.address = view.model;
      try {
        const glb = await this.#model(view.model);
        const seen = this.stage?.view ?? "three-quarter";
        if (head.address !== view.model) continue;
        await head.load(view, glb, seen);
        head.stage?.onChange(() => this.#announce());
        head.stage?.onTurn(() => this.#follow(version));
        byId("problem").hidden = true;
        this.#place();
        this.#ready?.();
      } catch (error) {
        head.address = "";
        byId("problem").hidden = false;
        write(byId("problem"), `The model cannot be shown: ${(error as Error).message}`);
        this.#complain(error as Error);
      }
    }
    this.#announce();
  }

  #model(address: string): Promise<ArrayBuffer> {
    const known = this.#models.get(address) ?? this.#session.connection.fetch(address);
    this.#models.set(address, known);
    known.catch(() => this.#models.delete(address));
    return known;
  }

  /** Two faces side by side are looked at from the same side. */
  #follow(version: "a" | "b"): void {
    const { a, b } = this.#heads;
    if (this.#following || this.shown !== "both" || a.address !== b.address) return;
    this.#following = true;
    const other = this.#heads[version === "a" ? "b" : "a"].stage;
    const own = this.#heads[version].stage;
    if (own && other) other.lookAs(own);
    this.#following = false;
  }

  #place(): void {
    const { clientWidth: width, clientHeight: height } = this.#box;
    if (!width || !height) return;
    const both = this.shown === "both";
    for (const version of ["a", "b"] as const) {
      const { canvas, stage } = this.#heads[version];
      canvas.hidden = !both && this.shown !== version;
      byId(`which-${version}`).hidden = !both;
      const own = both ? width / 2 : width;
      canvas.style.width = `${own}px`;
      canvas.style.left = both && version === "b" ? `${own}px` : "0";
      if (!canvas.hidden) stage?.resize(own, height);
    }
    this.#announce();
  }

  #views(): void {
    Object.entries(VIEWS).forEach(([name, view], index) => {
      byId("views").append(
        h(
          "button",
          {
            type: "button",
            "data-view": name,
            title: `${view.name} (${index + 1})`,
            "aria-label": view.name,
            onclick: () => this.setView(name),
          },
          SHORT[name],
        ),
      );
    });
  }

  showView(): void {
    for (const button of byId("views").querySelectorAll("button"))
      button.ariaPressed = String(button.dataset["view"] === this.stage?.view);
  }

  #announce(): void {
    this.#stale = true;
    this.showView();
    for (const listener of this.#listeners) listener();
  }
}
