/** What the stages do, as live controls: each with its value, its default, and the way back. */

import { byId, h, iconButton, put } from "../core/dom.ts";
import { dragName, Stream } from "../core/drag.ts";
import type { Session } from "../core/session.ts";
import type { Rule } from "../protocol.ts";

const keyOf = ({ kind, names, field }: Rule) => [kind, ...names, field].join("/");

type Field = HTMLInputElement | HTMLSelectElement;

export class Settings {
  #session: Session;
  #stream: Stream;
  #touched: () => void;
  #fields = new Map<string, { field: Field; row: HTMLElement; back: HTMLButtonElement | null }>();
  #made = "";

  constructor(session: Session, touched: () => void) {
    this.#session = session;
    this.#touched = touched;
    this.#stream = new Stream(session);
    session.on(["hello", "rules"], () => this.update());
  }

  update(): void {
    const rules = this.#session.rules;
    const key = rules.map(keyOf).join("\n");
    if (key !== this.#made) this.#make(rules);
    this.#made = key;
    for (const rule of rules) {
      const found = this.#fields.get(keyOf(rule));
      if (!found) continue;
      const changed = rule.value !== rule.default;
      found.row.classList.toggle("changed", changed);
      if (found.back) found.back.disabled = !changed;
      if (document.activeElement !== found.field || !this.#stream.busy)
        found.field.value = String(rule.value);
      found.field.title = titleOf(rule);
    }
  }

  #make(rules: Rule[]): void {
    this.#fields.clear();
    const of = (kind: Rule["kind"]) => rules.filter((rule) => rule.kind === kind);
    put(
      byId("settings"),
      h(
        "div",
        { class: "rules" },
        h("h3", {}, "How a line is made"),
        ...of("setting").map((rule) => this.#row(rule, rule.field.replaceAll("_", " "))),
        h("h3", {}, "Poses that exclude each other, from this sum"),
        ...of("threshold").map((rule) => this.#row(rule, rule.names.join(" and "))),
        h("h3", {}, "Each pose"),
        this.#table(of("pose"), of("gain")),
      ),
    );
  }

  #row(rule: Rule, name: string): HTMLElement {
    const field = this.#field(rule);
    const back = iconButton("reset", `${name}: back to ${rule.default}`, () =>
      this.#set(rule, null),
    );
    const unit = rule.unit ? h("small", {}, ` ${rule.unit}`) : null;
    const row = h(
      "div",
      { class: "rule", title: titleOf(rule) },
      h("span", { class: "rule-name" }, name, unit),
      field,
      back,
    );
    this.#fields.set(keyOf(rule), { field, row, back });
    return row;
  }

  #table(rules: Rule[], gains: Rule[]): HTMLElement {
    const names = [...new Set(rules.flatMap((rule) => rule.names))];
    const fields = [...new Set(rules.map((rule) => rule.field))];
    const title = (field: string) => rules.find((rule) => rule.field === field)?.about ?? "";
    const head = h(
      "tr",
      {},
      h("th", {}, ""),
      ...fields.map((field) => h("th", { title: title(field) }, field)),
      gains.length ? h("th", { title: "What the pose's curves are multiplied by" }, "gain") : null,
    );
    const rows = names.map((name) => {
      const own = fields.map((field) =>
        rules.find((rule) => rule.names[0] === name && rule.field === field),
      );
      const gain = gains.find((rule) => rule.names[0] === name);
      const cells = [...own, ...(gains.length ? [gain] : [])].map((rule) => {
        const cell = h("td");
        if (!rule) return cell;
        const field = this.#field(rule);
        this.#fields.set(keyOf(rule), { field, row: cell, back: null });
        cell.append(field);
        return cell;
      });
      return h("tr", {}, h("th", { scope: "row" }, name), ...cells);
    });
    return h("table", { class: "rules-table" }, head, ...rows);
  }

  #field(rule: Rule): Field {
    const words = [...rule.names, rule.field.replaceAll("_", " ")].filter(Boolean).join(" ");
    if (rule.choices.length) {
      const select = h("select", { "aria-label": words });
      for (const choice of rule.choices) select.append(h("option", {}, choice));
      select.addEventListener("change", () => this.#set(rule, select.value));
      return select;
    }
    const input = h("input", { type: "text", inputmode: "decimal", "aria-label": words });
    const type = () => {
      const typed = Number(input.value.replace(",", "."));
      if (input.value.trim() && Number.isFinite(typed)) this.#set(rule, typed);
      else input.value = String(rule.value);
    };
    input.addEventListener("change", type);
    input.addEventListener("focus", () => input.select());
    input.addEventListener("keydown", (event) => this.#key(event, rule, input));
    input.addEventListener("pointerdown", (event) => this.#scrub(event, rule, input));
    return input;
  }

  /** Up and down change a number by a step; Escape takes it back to the default. */
  #key(event: KeyboardEvent, rule: Rule, input: HTMLInputElement): void {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (event.key === "Enter") input.blur();
    else if (way) {
      const next = bounded(
        rule,
        Number(input.value) + way * stepOf(rule) * (event.shiftKey ? 10 : 1),
      );
      input.value = String(next);
      this.#set(rule, next);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Drag sideways over a number to change it, as in other tools of the trade. */
  #scrub(event: PointerEvent, rule: Rule, input: HTMLInputElement): void {
    if (document.activeElement === input || event.button !== 0) return;
    const from = event.clientX;
    const was = Number(input.value);
    const drag = dragName("rule");
    let moved = false;
    input.setPointerCapture(event.pointerId);
    const move = (now: PointerEvent) => {
      const pixels = now.clientX - from;
      if (!moved && Math.abs(pixels) < 4) return;
      moved = true;
      const next = bounded(rule, was + Math.round(pixels / 4) * stepOf(rule));
      input.value = String(next);
      this.#set(rule, next, drag);
    };
    input.addEventListener("pointermove", move);
    input.addEventListener(
      "pointerup",
      () => {
        input.removeEventListener("pointermove", move);
        if (moved) input.blur();
      },
      { once: true },
    );
  }

  #set(rule: Rule, value: number | string | null, drag = dragName("rule")): void {
    this.#touched();
    const { kind, names, field } = rule;
    const target = this.#session.target;
    this.#stream.push({ type: "setRule", target, kind, names, field, value }, drag);
  }
}

function stepOf(rule: Rule): number {
  if (rule.field === "priority" || rule.field === "limit") return 1;
  return rule.unit === "s" ? 0.005 : 0.05;
}

function bounded(rule: Rule, value: number): number {
  const rounded = Math.round(value * 1000) / 1000;
  const most = rule.most > rule.least ? rule.most : Number.POSITIVE_INFINITY;
  return Math.min(Math.max(rounded, rule.least), most);
}

function titleOf({ about, value, default: own, opened, unit, least, most }: Rule): string {
  const more = unit ? ` ${unit}` : "";
  const parts = [about, `default ${own}${more}`];
  if (opened !== own) parts.push(`opened with ${opened}${more}`);
  if (value !== own) parts.push(`now ${value}${more}`);
  if (most > least) parts.push(`${least} to ${most}`);
  return parts.filter(Boolean).join("\n");
}
