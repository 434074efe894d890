/** Save: what would be written is shown first, and what somebody else wrote meanwhile beside it. */

import { byId, h, put } from "../core/dom.ts";
import type { Session } from "../core/session.ts";
import type { FileInfo, Hello, PreviewView, Saved } from "../protocol.ts";

const NAMES: Record<FileInfo["document"], string> = {
  set: "the set",
  overrides: "overrides",
  edits: "corrections",
  labels: "phone times",
};

export class SaveDialog {
  #session: Session;
  #dialog = byId<HTMLDialogElement>("saving");
  #file: FileInfo | null = null;
  #preview: PreviewView | null = null;
  #name = "";
  #said = "";
  #complain: (error: Error) => void;

  constructor(session: Session, complain: (error: Error) => void) {
    this.#session = session;
    this.#complain = complain;
    session.on("files", () => this.#mark());
  }

  async open(): Promise<void> {
    const files = this.#session.files;
    const first = files.find(({ dirty }) => dirty) ?? files[0];
    this.#said = "";
    this.#dialog.showModal();
    await this.#choose(first ?? null);
  }

  #mark(): void {
    const dirty = this.#session.files.some((file) => file.dirty);
    byId("unsaved").hidden = !dirty;
    byId("save").classList.toggle("dirty", dirty);
    document.title = `${dirty ? "• " : ""}${document.title.replace(/^• /, "")}`;
  }

  async #choose(file: FileInfo | null): Promise<void> {
    this.#file = file;
    this.#name = file ? file.path || file.suggested : "";
    await this.#look();
  }

  async #look(): Promise<void> {
    const file = this.#file;
    this.#preview = null;
    if (file?.dirty || file?.path) {
      const { document, line } = file;
      const name = file.path ? "" : this.#name;
      try {
        const ask = { type: "preview" as const, document, line, name };
        this.#preview = await this.#session.ask<PreviewView>(ask);
      } catch (error) {
        this.#said = (error as Error).message;
      }
    }
    this.#show();
  }

  #show(): void {
    const file = this.#file;
    const view = this.#preview;
    const files = this.#session.files;
    const title = h("h2", { id: "saving-title" }, "Save");
    const close = h("button", { class: "quiet icon", title: "Close (Esc)" }, "✕");
    const head = h("form", { method: "dialog" }, title, close);
    if (!file) return put(this.#dialog, head, h("p", {}, "Nothing has been changed."));
    put(
      this.#dialog,
      head,
      this.#choice(files, file),
      this.#path(file),
      this.#said ? h("p", { role: "status" }, this.#said) : null,
      view?.refused ? h("p", { class: "alarm", role: "alert" }, view.refused) : null,
      view?.theirs ? this.#conflict(view) : view ? diffOf(view.diff) : null,
      view && !view.diff ? h("p", {}, "The file says just this already.") : null,
      this.#actions(file, view),
    );
    this.#dialog.querySelector<HTMLButtonElement>(".actions .primary:not(:disabled)")?.focus();
  }

  #choice(files: FileInfo[], file: FileInfo): HTMLElement {
    const select = h("select", { "aria-label": "What to save", id: "save-what" });
    for (const each of files) {
      const line = this.#session.lines.find(({ id }) => id === each.line)?.title;
      const words = `${NAMES[each.document]}${line ? ` of “${line}”` : ""}${each.dirty ? " •" : ""}`;
      const own = each.document === file.document && each.line === file.line;
      select.append(h("option", { selected: own }, words));
    }
    select.addEventListener("change", () => {
      this.#said = "";
      void this.#choose(files[select.selectedIndex]);
    });
    const about = h("small", {}, file.about);
    return h(
      "div",
      { class: "form-row" },
      h("span", {}, "what"),
      h("span", {}, select, " ", about),
    );
  }

  #path(file: FileInfo): HTMLElement {
    const field = h("input", {
      id: "save-name",
      value: this.#name,
      disabled: Boolean(file.path),
      "aria-label": "File",
      spellcheck: "false",
    });
    field.addEventListener("change", () => {
      this.#name = field.value.trim();
      void this.#look();
    });
    return h("div", { class: "form-row" }, h("span", {}, file.path ? "file" : "new file"), field);
  }

  /** What they and we changed since it was opened, both shown. */
  #conflict(view: PreviewView): HTMLElement {
    const both = view.both.length ? ` Both changed: ${view.both.join(", ")}.` : "";
    return h(
      "div",
      { id: "conflict" },
      h(
        "p",
        { class: "alarm", role: "alert" },
        `The file was changed by somebody else since it was opened.${both}`,
      ),
      h(
        "div",
        { class: "diff-pair" },
        h("div", {}, h("h2", {}, "What they changed"), diffOf(view.theirs)),
        h("div", {}, h("h2", {}, "What writing ours would do now"), diffOf(view.diff)),
      ),
    );
  }

  #actions(file: FileInfo, view: PreviewView | null): HTMLElement {
    const button = (words: string, act: () => void, primary = false) =>
      h("button", { type: "button", class: primary ? "primary" : "", onclick: act }, words);
    const actions = h("div", { class: "actions" });
    if (view?.theirs) {
      actions.append(
        button("Read theirs, drop ours", () => void this.#reread(file, false)),
        button("Read theirs, lay ours over it", () => void this.#reread(file, true), true),
      );
    } else {
      const write = button(file.path || view?.isNew === false ? "Write" : "Write new file", () => {
        void this.#write(file, view);
      });
      write.id = "write";
      write.classList.add("primary");
      write.disabled = !view || Boolean(view.refused) || !view.diff;
      actions.append(
        button("Close", () => this.#dialog.close()),
        write,
      );
    }
    return actions;
  }

  async #write(file: FileInfo, view: PreviewView | null): Promise<void> {
    if (!view) return;
    const { document, line } = file;
    const name = file.path ? "" : this.#name;
    try {
      const ask = { type: "save" as const, document, line, name, digest: view.digest };
      const answer = await this.#session.ask<Saved | PreviewView>(ask);
      if (answer.type === "preview") {
        this.#preview = answer;
        this.#said = "Meanwhile the file has become another: nothing was written.";
        return this.#show();
      }
      this.#said = `Written: ${answer.path}`;
      const next = answer.files.find((each) => each.dirty);
      const same = answer.files.find((each) => each.document === document && each.line === line);
      await this.#choose(next ?? same ?? null);
    } catch (error) {
      this.#said = (error as Error).message;
      this.#show();
    }
  }

  async #reread(file: FileInfo, keep: boolean): Promise<void> {
    try {
      await this.#session.ask<Hello>({ type: "reread", document: file.document, keep });
      this.#said = keep ? "Ours now lies over theirs." : "Theirs was read.";
      const { document, line } = file;
      const same = (each: FileInfo) => each.document === document && each.line === line;
      await this.#choose(this.#session.files.find(same) ?? null);
    } catch (error) {
      this.#complain(error as Error);
    }
  }
}

/** A unified diff, its lines told apart by colour and by their first letter. */
function diffOf(diff: string): HTMLElement {
  const lines = diff.replace(/\n$/, "").split("\n");
  const kind = (line: string) =>
    line.startsWith("+++") || line.startsWith("---") || line.startsWith("@@")
      ? "place"
      : line.startsWith("+")
        ? "added"
        : line.startsWith("-")
          ? "removed"
          : "";
  return h(
    "div",
    { class: "diff", tabindex: 0, role: "region", "aria-label": "What will change in the file" },
    ...(diff ? lines.map((line) => h("div", { class: kind(line) }, line)) : []),
  );
}
