/** Light or dark: as the system says, until the user says otherwise. */

const PLACE = "lipwright-theme";
const system = matchMedia("(prefers-color-scheme: light)");

export function isDark(): boolean {
  return document.documentElement.dataset["theme"] !== "light";
}

export function followTheme(changed: () => void): void {
  apply();
  system.addEventListener("change", () => {
    apply();
    changed();
  });
}

export function toggleTheme(): void {
  const next = isDark() ? "light" : "dark";
  const usual = system.matches ? "light" : "dark";
  try {
    if (next === usual) localStorage.removeItem(PLACE);
    else localStorage.setItem(PLACE, next);
  } catch {
    // It is kept for this page alone.
  }
  document.documentElement.dataset["theme"] = next;
}

function apply(): void {
  let chosen: string | null = null;
  try {
    chosen = localStorage.getItem(PLACE);
  } catch {
    // As the system says, then.
  }
  document.documentElement.dataset["theme"] = chosen ?? (system.matches ? "light" : "dark");
}
