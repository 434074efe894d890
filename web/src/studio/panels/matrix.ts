/** The table of pairs: first phone by row, second by column; a grid for eyes, keys and readers. */

import { byId, h, put } from "../core/dom.ts";
import { nameOf, type Pair, type Session } from "../core/session.ts";
import type { Cell } from "../protocol.ts";

const HEAD = { side: 34, top: 30 };
const SMALLEST = 11;
const LARGEST = 22;

export class Matrix {
  #session: Session;
  #host = byId("matrix");
  #cells = new Map<string, HTMLElement>();
  #heads = { side: new Map<string, HTMLElement>(), top: new Map<string, HTMLElement>() };
  #focused: Pair = ["f", "ah"];
  #open: (pair: Pair) => void;
  #openPhone: (phone: string) => void;

  constructor(session: Session, open: (pair: Pair) => void, openPhone: (phone: string) => void) {
    this.#session = session;
    this.#open = open;
    this.#openPhone = openPhone;
    session.on("hello", () => this.#make());
    session.on("cells", () => this.update());
    this.#host.addEventListener("keydown", (event) => this.#key(event));
    this.#host.addEventListener("click", (event) => {
      const pair = pairOf(event.target);
      if (pair) this.#open(pair);
    });
    this.#host.addEventListener("pointerover", (event) => this.#caption(pairOf(event.target)));
    this.#host.addEventListener("pointerleave", () => this.#caption(null));
    this.#host.addEventListener("focusin", (event) => this.#caption(pairOf(event.target)));
    new ResizeObserver(() => this.#size()).observe(byId("navigator"));
  }

  /** Mark the pair that is open. */
  choose(pair: Pair | null): void {
    for (const cell of this.#host.querySelectorAll('[aria-selected="true"]'))
      cell.ariaSelected = "false";
    if (!pair) return;
    const cell = this.#cells.get(nameOf(pair));
    if (cell) cell.ariaSelected = "true";
    this.#rove(pair, false);
    this.#caption(null);
  }

  update(): void {
    const cells = [...this.#session.cells.values()];
    const most = Math.max(1e-9, ...cells.map(({ need }) => need));
    for (const cell of cells) {
      const element = this.#cells.get(nameOf(cell.pair));
      if (element) dress(element, cell, most);
    }
    this.#caption(null);
  }

  get #classes(): string[] {
    return this.#session.hello?.classes.map(({ label }) => label) ?? [];
  }

  #make(): void {
    const classes = this.#classes;
    const shown = [...this.#heads.side.keys()];
    if (shown.length === classes.length && shown.every((label, at) => label === classes[at]))
      return;
    for (const map of [this.#cells, this.#heads.side, this.#heads.top]) map.clear();
    const head = h("div", { class: "row", role: "row" }, h("span"));
    for (const label of classes) head.append(this.#head(label, "top"));
    const rows = classes.map((first) => {
      const row = h("div", { class: "row", role: "row" }, this.#head(first, "side"));
      for (const second of classes) row.append(this.#cell([first, second]));
      return row;
    });
    put(this.#host, head, ...rows);
    this.#size();
    this.update();
    this.#rove(this.#focused, false);
  }

  #head(label: string, side: "side" | "top"): HTMLElement {
    const word = this.#session.hello?.classes.find((each) => each.label === label)?.word ?? "";
    const role = side === "top" ? "columnheader" : "rowheader";
    const title = `/${label}/ as in ${word}${side === "side" ? ": its single curve" : ""}`;
    const head = h("span", { class: `head ${side}`, role, title }, label);
    if (side === "side") head.addEventListener("click", () => this.#openPhone(label));
    this.#heads[side].set(label, head);
    return head;
  }

  #cell(pair: Pair): HTMLElement {
    const cell = h("div", {
      class: "cell",
      role: "gridcell",
      tabindex: -1,
      "aria-selected": "false",
      "data-first": pair[0],
      "data-second": pair[1],
    });
    this.#cells.set(nameOf(pair), cell);
    if (!this.#session.cells.has(nameOf(pair))) cell.classList.add("none");
    return cell;
  }

  #size(): void {
    const count = this.#classes.length;
    if (!count) return;
    const box = byId("navigator");
    if (!box.clientWidth) return;
    const wide = (box.clientWidth - HEAD.side - 12) / count;
    const tall = (box.clientHeight - HEAD.top - 96) / count;
    const size = Math.max(Math.min(wide, tall, LARGEST), SMALLEST);
    this.#host.style.gridTemplateColumns = `${HEAD.side}px repeat(${count}, ${size}px)`;
    this.#host.style.gridTemplateRows = `${HEAD.top}px repeat(${count}, ${size}px)`;
    this.#host.style.fontSize = `${Math.min(Math.max(size * 0.68, 9), 12)}px`;
  }

  #key(event: KeyboardEvent): void {
    const [dy, dx] =
      { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key] ??
      [];
    if (event.key === "Enter" || event.key === " ") this.#open(this.#focused);
    else if (event.key === "s") this.#openPhone(this.#focused[0]);
    else if (event.key === "Home") this.#rove([this.#focused[0], this.#classes[0]], true);
    else if (event.key === "End")
      this.#rove([this.#focused[0], this.#classes[this.#classes.length - 1]], true);
    else if (dx !== undefined && dy !== undefined) {
      const classes = this.#classes;
      const [row, column] = this.#focused.map((label) => classes.indexOf(label));
      const next: Pair = [
        classes[Math.min(Math.max(row + dy, 0), classes.length - 1)],
        classes[Math.min(Math.max(column + dx, 0), classes.length - 1)],
      ];
      this.#rove(next, true);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** One cell of the grid can be reached with Tab, and the arrows move it. */
  #rove(pair: Pair, focus: boolean): void {
    const cell = this.#cells.get(nameOf(pair));
    if (!cell || cell.classList.contains("none")) return;
    const before = this.#cells.get(nameOf(this.#focused));
    if (before) before.tabIndex = -1;
    cell.tabIndex = 0;
    this.#focused = pair;
    if (focus) cell.focus();
  }

  #caption(pair: Pair | null): void {
    const shown = pair ?? (this.#session.watched.pair as Pair | null);
    for (const [side, label] of [
      ["side", shown?.[0]],
      ["top", shown?.[1]],
    ] as const)
      for (const [name, head] of this.#heads[side]) head.classList.toggle("lit", name === label);
    const cell = shown && this.#session.cells.get(nameOf(shown));
    const host = byId("pair-caption");
    if (!cell) return put(host);
    put(
      host,
      h("strong", {}, cell.pair.join(" – ")),
      ...describe(cell).map((t) => h("span", {}, t)),
    );
  }
}

function dress(element: HTMLElement, cell: Cell, most: number): void {
  const state = cell.state.replace(" ", "-");
  element.className = `cell ${state}`;
  element.classList.toggle("overridden", cell.overridden);
  element.classList.toggle("changed", cell.changed);
  element.classList.toggle("needed", cell.need > 0);
  element.style.setProperty("--need", (0.62 * Math.sqrt(cell.need / most)).toFixed(3));
  element.ariaLabel = [cell.pair.join(" "), ...describe(cell)].join(", ");
}

function describe(cell: Cell): string[] {
  return [
    cell.overridden
      ? "overridden"
      : { drawn: "drawn", "stand-in": "stands in", "no curve": "no curve" }[cell.state],
    cell.word && `“${cell.word}”`,
    cell.need > 0
      ? `${(100 * cell.need).toFixed(cell.need < 0.001 ? 2 : 1)} % of what is needed`
      : "",
    cell.edits ? `${cell.edits} edits` : "",
    cell.changed ? "changed" : "",
  ].filter((part): part is string => Boolean(part));
}

function pairOf(target: EventTarget | null): Pair | null {
  const cell = target instanceof Element ? target.closest<HTMLElement>(".cell") : null;
  const { first, second } = cell?.dataset ?? {};
  return first && second && !cell?.classList.contains("none") ? [first, second] : null;
}
