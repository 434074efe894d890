/**
 * Nine colours that stay apart in protanopia, deuteranopia and tritanopia, and stand out from the
 * page (contrast 3:1 or more); further curves repeat them with dashes.
 */

const LIGHT = [
  "#9e410e",
  "#427df8",
  "#7a7418",
  "#c25e9c",
  "#0349c1",
  "#602500",
  "#5d476c",
  "#05078f",
  "#380a40",
];
const DARK = [
  "#f9691c",
  "#33ccef",
  "#f7f56a",
  "#b77f9c",
  "#708cfc",
  "#d1c38f",
  "#b5fbfb",
  "#b64014",
  "#695ca1",
];
const DASHES = [[], [6, 3], [2, 2], [8, 3, 2, 3]];

export interface Stroke {
  colour: string;
  dash: number[];
}

export function stroke(index: number, dark: boolean): Stroke {
  const colours = dark ? DARK : LIGHT;
  return {
    colour: colours[index % colours.length],
    dash: DASHES[Math.floor(index / colours.length) % DASHES.length],
  };
}
