/** The colours of the theme, for what is drawn on canvases. */

export interface Ink {
  dark: boolean;
  text: string;
  muted: string;
  line: string;
  page: string;
  panel: string;
  raised: string;
  wave: string;
  accent: string;
  soft: string;
  playhead: string;
  font: string;
}

export function readInk(canvas: HTMLCanvasElement): Ink {
  const style = getComputedStyle(canvas);
  const ink = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    dark: ink("dark") === "1",
    text: ink("text"),
    muted: ink("muted"),
    line: ink("line"),
    page: ink("page"),
    panel: ink("panel"),
    raised: ink("raised"),
    wave: ink("wave"),
    accent: ink("accent"),
    soft: ink("accent-soft"),
    playhead: ink("playhead"),
    font: style.fontFamily,
  };
}
