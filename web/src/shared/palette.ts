/**
 * Nine colours that stay apart in protanopia, deuteranopia and tritanopia, and stand out from the
 * page (contrast 3:1 or more); both are held by a test. Further curves repeat them with dashes.
 */

// prettier-ignore
export const ON_LIGHT = [
  "#cd6d14", "#1850c9", "#3c928f", "#bf2c43", "#906ff1", "#804d89", "#7e160d", "#041888", "#48184c",
];
// prettier-ignore
export const ON_DARK = [
  "#f4b090", "#1a74eb", "#53e8f0", "#ec6ca0", "#9b98f3", "#d1fd73", "#a75307", "#a8980a", "#8b569d",
];
const DASHES = [[], [6, 3], [2, 2.5], [9, 3, 2, 3], [14, 5], [1, 5]];

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
