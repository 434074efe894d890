/** The keys: one table, from which the page listens and the help is written. */

export interface Key {
  /** As `KeyboardEvent.key` gives them; letters in lower case, `Shift+` before what needs it. */
  keys: string[];
  /** How the help writes them. */
  shown: string[];
  does: string;
  act: (key: string) => void;
}

const REPEATED = /Arrow|Page|^[-+=wasdqe,.]$/;

export function listen(table: Key[]): void {
  const actions = new Map(table.flatMap(({ keys, act }) => keys.map((key) => [key, act])));
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]"))
      return;
    if (event.key === " " && event.target instanceof HTMLButtonElement) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const act = (event.shiftKey && actions.get(`Shift+${key}`)) || actions.get(key);
    if (!act) return;
    event.preventDefault();
    if (!event.repeat || REPEATED.test(event.key)) act(key);
  });
  // A button that was clicked, rather than reached by Tab, leaves the space bar to the player.
  addEventListener("click", ({ detail, target }) => {
    const button = target instanceof Element ? target.closest("button") : null;
    if (detail > 0 && !button?.closest("dialog")) button?.blur();
  });
}

export function describe(list: HTMLElement, table: Key[]): void {
  for (const { shown, does } of table) {
    const keys = document.createElement("dt");
    shown.forEach((name, index) => {
      const key = document.createElement("kbd");
      key.textContent = name;
      keys.append(index ? " " : "", key);
    });
    const words = document.createElement("dd");
    words.textContent = does;
    list.append(keys, words);
  }
}
