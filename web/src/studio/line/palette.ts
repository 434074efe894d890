/**
 * The colours of the run-time stages: those of the publication's Figures 6 to 10, and, as the
 * default, ones that stay apart for colour-blind eyes. Each stage has dashes of its own as well.
 */

import { ON_DARK, ON_LIGHT } from "../../shared/palette.ts";

export type StageName = "placed" | "stitched" | "smoothed" | "constrained" | "limited";

export const STAGES: StageName[] = ["placed", "stitched", "smoothed", "constrained", "limited"];

export const ABOUT: Record<StageName, string> = {
  placed: "each pair's curve, laid over its two phones",
  stitched: "where two overlap, the greater",
  smoothed: "maxima close together joined by their chord",
  constrained: "poses that exclude each other give way",
  limited: "no faster than the pose's limit",
};

const FIGURES = {
  dark: ["#ff4b3e", "#5a7dff", "#ffe23d", "#2fe4e4", "#ff53ee"],
  light: ["#d4160b", "#1230e0", "#9a7d00", "#00848a", "#c211b4"],
};
/** Which of the nine curves' colours, which are known to stay apart, each stage takes. */
const APART = { dark: [3, 1, 5, 2, 0], light: [3, 1, 0, 2, 4] };
const DASHES = [[], [7, 3], [2, 2.5], [10, 3, 2, 3], []];
/** The curves that a stitched one is made of: green in the publication. */
const PARTS = { dark: "#43d15e", light: "#0d8a2b" };

export interface StageStroke {
  colour: string;
  dash: number[];
  wide: number;
}

export function stageStroke(name: StageName, dark: boolean, figures: boolean): StageStroke {
  const index = STAGES.indexOf(name);
  const theme = dark ? "dark" : "light";
  const apart = (dark ? ON_DARK : ON_LIGHT)[APART[theme][index]];
  return {
    colour: figures ? FIGURES[theme][index] : apart,
    dash: figures ? [] : DASHES[index],
    wide: name === "limited" ? 2.25 : 1.5,
  };
}

/** How the pieces beneath a stitched curve are drawn. */
export function partStroke(dark: boolean, figures: boolean): StageStroke {
  const theme = dark ? "dark" : "light";
  const colour = figures ? PARTS[theme] : dark ? "#8f98a4" : "#7b838d";
  return { colour, dash: [], wide: 1 };
}
