/** How the page is parted: bars between its parts can be dragged, or moved with arrows. */

const PLACE = "lipwright-layout";

interface Part {
  words: string;
  across: boolean;
  /** Whether the part grows when the bar goes right or down. */
  way: 1 | -1;
  least: number;
  /** Pixels that the rest of the page must keep. */
  rest: number;
}

const PARTS: Record<string, Part> = {
  navigator: { words: "Width of the table of pairs", across: true, way: 1, least: 250, rest: 700 },
  side: { words: "Width of the face", across: true, way: -1, least: 260, rest: 700 },
  deck: { words: "Height of the line", across: false, way: -1, least: 180, rest: 320 },
  inspector: { words: "Height of the inspector", across: false, way: -1, least: 120, rest: 220 },
};

export function makeSplitters(): void {
  const kept = read();
  for (const [name, size] of Object.entries(kept)) if (PARTS[name]) set(name, size, kept);
  for (const bar of document.querySelectorAll<HTMLElement>(".splitter")) {
    const name = bar.dataset["splits"] ?? "";
    const part = PARTS[name];
    if (!part) continue;
    bar.ariaLabel = part.words;
    bar.ariaOrientation = part.across ? "vertical" : "horizontal";
    bar.title = `${part.words}: drag, or double-click for the usual`;
    bar.addEventListener("pointerdown", (event) => drag(bar, name, part, event, kept));
    bar.addEventListener("dblclick", () => set(name, null, kept));
    bar.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
      if (!way) return;
      event.preventDefault();
      event.stopPropagation();
      set(name, sizeOf(name) + way * part.way * 16, kept);
    });
  }
}

/** Give the part under the pointer, or with the focus, the whole page; and take it back. */
export function toggleWhole(): void {
  const main = document.querySelector("main") as HTMLElement;
  if (main.dataset["whole"]) {
    delete main.dataset["whole"];
    return;
  }
  const part =
    main.querySelector(":scope > section:hover") ??
    document.activeElement?.closest("main > section") ??
    null;
  if (part) main.dataset["whole"] = part.id;
}

/** A part has something to show: it is not to lie behind another that fills the page. */
export function makeSeen(part: string): void {
  const main = document.querySelector("main") as HTMLElement;
  if (main.dataset["whole"] !== part) delete main.dataset["whole"];
}

function drag(
  bar: HTMLElement,
  name: string,
  part: Part,
  event: PointerEvent,
  kept: Record<string, number>,
): void {
  const from = part.across ? event.clientX : event.clientY;
  const was = sizeOf(name);
  bar.setPointerCapture(event.pointerId);
  const move = (now: PointerEvent) =>
    set(name, was + part.way * ((part.across ? now.clientX : now.clientY) - from), kept);
  bar.addEventListener("pointermove", move);
  bar.addEventListener("pointerup", () => bar.removeEventListener("pointermove", move), {
    once: true,
  });
}

function sizeOf(name: string): number {
  return Number.parseFloat(
    getComputedStyle(document.documentElement).getPropertyValue(`--${name}`),
  );
}

function set(name: string, size: number | null, kept: Record<string, number>): void {
  const { style } = document.documentElement;
  if (size === null) {
    style.removeProperty(`--${name}`);
    delete kept[name];
  } else {
    const { across, least, rest } = PARTS[name];
    const most = Math.max((across ? innerWidth : innerHeight) - rest, least);
    kept[name] = Math.round(Math.min(Math.max(size, least), most));
    style.setProperty(`--${name}`, `${kept[name]}px`);
  }
  try {
    localStorage.setItem(PLACE, JSON.stringify(kept));
  } catch {
    // Where nothing is kept, the page is parted as usual the next time.
  }
}

function read(): Record<string, number> {
  try {
    return JSON.parse(localStorage.getItem(PLACE) ?? "{}");
  } catch {
    return {};
  }
}
