/**
 * Seven colours that stay apart in protanopia, deuteranopia and tritanopia, and stand out from the
 * page (contrast 3:1 or more, both held by a test); further curves repeat them with dashes.
 */

export const ON_LIGHT = [
  "#908712",
  "#1d45c1",
  "#4889fc",
  "#273e06",
  "#5c0262",
  "#e154a8",
  "#91485d",
];
export const ON_DARK = [
  "#fbe43c",
  "#1973ea",
  "#94f9fd",
  "#14c877",
  "#bea7f5",
  "#b52b80",
  "#907c0f",
];
const DASHES = [[], [6, 3], [2, 2.5], [9, 3, 2, 3]];

export interface Stroke {
  colour: string;
  dash: number[];
}

export function stroke(index: number, dark: boolean): Stroke {
  const colours = dark ? ON_DARK : ON_LIGHT;
  return {
    colour: colours[index % colours.length],
    dash: DASHES[Math.floor(index / colours.length) % DASHES.length],
  };
}
