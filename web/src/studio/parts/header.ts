/** The head of the page: what is open, where changes go, who speaks, undo, save, theme. */

import { byId, h, icon, put, write } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import { isDark } from "../core/theme.ts";

export interface HeaderHooks {
  save(): void;
  help(): void;
  theme(): void;
  /** Changes go elsewhere from now on. */
  target(): void;
  complain(error: Error): void;
}

export class Header {
  #session: Session;
  #hooks: HeaderHooks;

  constructor(session: Session, hooks: HeaderHooks) {
    this.#session = session;
    this.#hooks = hooks;
    this.#buttons();
    session.on("hello", () => this.#greet());
    session.on(["hello", "character"], () => this.#characters());
    session.on("history", () => this.#history());
    session.on("online", () => {
      byId("offline").hidden = session.connection.online;
    });
    session.on("progress", () => {
      const { progress } = session;
      const share = progress?.share ? ` ${Math.round(100 * progress.share)} %` : "…";
      write(byId("progress"), progress ? progress.what + share : "");
    });
  }

  restyle(): void {
    const words = h("span", { class: "hidden" }, "Light or dark");
    put(byId("theme"), icon(isDark() ? "sun" : "moon"), words);
  }

  #greet(): void {
    const { hello, target } = this.#session;
    if (!hello) return;
    write(byId("set-name"), `set ${hello.setName}`);
    byId("set-name").title = hello.setAbout;
    document.title = `${hello.setName} – Lipwright studio`;
    byId<HTMLSelectElement>("target").value = target;
  }

  #characters(): void {
    const { hello, character } = this.#session;
    const now = character.a;
    if (!hello || !now) return;
    const select = byId<HTMLSelectElement>("character");
    const title = (name: string) => (name === now.name ? now.title || name : name);
    const names = [...new Set([now.name, ...hello.characters])];
    put(select, ...names.map((name) => h("option", { value: name }, title(name))));
    select.value = now.name;
    select.title = now.notes.join("\n");
  }

  #history(): void {
    const { undo, redo, undoSteps } = this.#session.history;
    const set = (id: string, words: string, name: string, keys: string) => {
      const button = byId<HTMLButtonElement>(id);
      button.disabled = !words;
      button.title = words ? `${name}: ${words} (${keys})` : name;
    };
    set("undo", undo, "Undo", "Ctrl Z");
    set("redo", redo, "Do again", "Ctrl Shift Z");
    byId("undo").dataset["steps"] = String(undoSteps);
  }

  #buttons(): void {
    const session = this.#session;
    const button = (id: string, shape: string, words: string, act: () => void) => {
      put(byId(id), icon(shape), h("span", { class: "hidden" }, words));
      byId(id).addEventListener("click", act);
    };
    button("undo", "undo", "Undo", () => session.undo());
    button("redo", "redo", "Do again", () => session.redo());
    button("theme", isDark() ? "sun" : "moon", "Light or dark", () => this.#hooks.theme());
    byId("save").addEventListener("click", () => this.#hooks.save());
    byId("keys").addEventListener("click", () => this.#hooks.help());
    this.#select("target", (target) => {
      session.target = target as "overrides" | "set";
      this.#hooks.target();
    });
    this.#select("character", (name) => {
      session.ask({ type: "character", name }).catch(this.#hooks.complain);
    });
  }

  #select(id: string, act: (value: string) => void): void {
    const element = byId<HTMLSelectElement>(id);
    element.addEventListener("change", () => {
      act(element.value);
      element.blur();
    });
  }
}
