/** The views from which to look at a model. */

import type { Framing } from "./framing.ts";

export interface View {
  name: string;
  label: string;
  /** Degrees from the front, towards the model's left, and above the horizon. */
  azimuth: number;
  elevation: number;
  part: keyof Framing;
}

export const VIEWS: Record<string, View> = {
  front: { name: "Front", label: "Front", azimuth: 0, elevation: 1, part: "head" },
  "three-quarter": { name: "Three-quarter", label: "¾", azimuth: 38, elevation: 3, part: "head" },
  side: { name: "Side", label: "Side", azimuth: 90, elevation: 0, part: "head" },
  mouth: { name: "Mouth", label: "Mouth", azimuth: 0, elevation: 0, part: "mouth" },
  "mouth-side": {
    name: "Mouth, three-quarter",
    label: "Mouth ¾",
    azimuth: 52,
    elevation: 2,
    part: "mouth",
  },
};
