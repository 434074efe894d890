/** Elements of the page, made in one call each. */

type Value = string | number | boolean | null | undefined | ((event: never) => void);
export type Child = Node | string | null | undefined | false;

/** Make an element: `on…` are listeners, `class` and attributes as HTML writes them. */
export function h<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function")
      element.addEventListener(name.slice(2), value as unknown as EventListener);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined)
      element.setAttribute(name, String(value));
  }
  put(element, ...children);
  return element;
}

/** Put children in the place of those that are there. */
export function put(element: Element, ...children: Child[]): void {
  element.replaceChildren(...(children.filter(Boolean) as (Node | string)[]));
}

export function byId<Kind extends HTMLElement>(id: string): Kind {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element "${id}"`);
  return found as Kind;
}

/** Write a text only where it differs: the page is laid out again for each that is written. */
export function write(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

const SHAPES: Record<string, string> = {
  undo: "M7 5 3.5 8.5 7 12M4 8.5h7.5a4 4 0 0 1 0 8H8",
  redo: "m13 5 3.5 3.5L13 12M16 8.5H8.5a4 4 0 0 0 0 8H12",
  plus: "M10 4.5v11M4.5 10h11",
  minus: "M4.5 10h11",
  close: "m5.5 5.5 9 9m0-9-9 9",
  mirror: "M10 3.5v13M7.5 6 3.5 14h4zM12.5 6l4 8h-4z",
  copy: "M7.5 7.5h8v8h-8zM12.5 7.5v-3h-8v8h3",
  paste: "M5 4.5h10v12H5zM8 3.5h4v2.5H8z",
  fit: "M4 8V4h4M16 8V4h-4M4 12v4h4M16 12v4h-4",
  grow: "M12 4h4v4M16 4l-5 5M8 16H4v-4M4 16l5-5",
  sound: "M3.5 8h3L10 5v10l-3.5-3h-3zM13 7.5a3.6 3.6 0 0 1 0 5M15 5.5a6.4 6.4 0 0 1 0 9",
  trash: "M4.5 6h11M8 6V4.5h4V6M6 6l.7 10h6.6L14 6",
  sun: "M10 7a3 3 0 1 0 0 6 3 3 0 0 0 0-6M10 3v1.5M10 15.5V17M3 10h1.5M15.5 10H17M5 5l1.1 1.1M13.9 13.9 15 15M5 15l1.1-1.1M13.9 6.1 15 5",
  moon: "M15.5 12.5A6.5 6.5 0 0 1 7.5 4.5a6.5 6.5 0 1 0 8 8z",
  magnet: "M5 4h3v6a2 2 0 0 0 4 0V4h3v6a5 5 0 0 1-10 0zM5 6.5h3M12 6.5h3",
  reset: "M4.5 10a5.5 5.5 0 1 0 1.8-4.1M6.5 3v3.2h3.2",
  play: "M6.5 4.5v11l8.5-5.5z",
  lanes: "M3.5 5h13M3.5 10h13M3.5 15h13",
  edit: "m4 16 1-3.5L13 4.5l2.5 2.5-8 8z",
};

/** A drawing for a button; it says nothing to a screen reader. */
export function icon(name: string): SVGElement {
  const drawing = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  drawing.setAttribute("viewBox", "0 0 20 20");
  drawing.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", SHAPES[name] ?? "");
  drawing.append(path);
  return drawing;
}

/** A quiet button with a drawing; `words` are its name, and with the keys its title. */
export function iconButton(
  shape: string,
  words: string,
  act: () => void,
  keys = "",
): HTMLButtonElement {
  return h(
    "button",
    {
      type: "button",
      class: "quiet icon small",
      title: keys ? `${words} (${keys})` : words,
      "aria-label": words,
      onclick: act,
    },
    icon(shape),
  );
}

/** A swatch of a curve: its colour and dashes. */
export function swatch(colour: string, dash: number[]): SVGElement {
  const drawing = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  drawing.setAttribute("viewBox", "0 0 16 4");
  drawing.setAttribute("class", "swatch");
  drawing.setAttribute("aria-hidden", "true");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  line.setAttribute("d", "M0 2h16");
  line.setAttribute("stroke", colour);
  line.setAttribute("stroke-width", "3");
  line.setAttribute("stroke-dasharray", dash.join(" "));
  drawing.append(line);
  return drawing;
}
