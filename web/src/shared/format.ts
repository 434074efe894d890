/** How times and numbers are written. */

/** `1.5` becomes `0:01.500`; times before the sound have a minus sign. */
export function clockTime(seconds: number): string {
  const total = Math.round(Math.abs(seconds) * 1000);
  const sign = seconds < 0 && total > 0 ? "−" : "";
  const minutes = Math.floor(total / 60000);
  const rest = ((total % 60000) / 1000).toFixed(3).padStart(6, "0");
  return `${sign}${minutes}:${rest}`;
}

/** A label for the ruler: no more digits than the step between two labels needs. */
export function rulerTime(seconds: number, step: number): string {
  const digits = step >= 1 ? 0 : step >= 0.1 ? 1 : 2;
  const value = Math.abs(seconds) < step / 100 ? 0 : seconds;
  if (Math.abs(value) < 60) return `${value.toFixed(digits).replace("-", "−")} s`;
  const sign = value < 0 ? "−" : "";
  const minutes = Math.floor(Math.abs(value) / 60 + 1e-9);
  const rest = (Math.abs(value) - 60 * minutes).toFixed(digits);
  return `${sign}${minutes}:${rest.padStart(digits ? digits + 3 : 2, "0")}`;
}

const LONG_STEPS = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1200, 1800, 3600];

/** The shortest step that reads well and is at least `least` seconds: 0.1, 0.2, 0.5, 1, 2, 5… */
export function niceStep(least: number): number {
  if (least > 1) return LONG_STEPS.find((step) => step >= least) ?? 7200;
  const power = 10 ** Math.floor(Math.log10(least));
  const factor = [1, 2, 5, 10].find((each) => each * power >= least * (1 - 1e-9)) ?? 10;
  return factor * power;
}

export function milliseconds(seconds: number): string {
  return `${Math.round(seconds * 1000)} ms`;
}
