/** A pair, or a single phone, as the curve editor shows it. */

import type { Session } from "../core/session.ts";
import type { BigramView, PhoneView } from "../protocol.ts";
import type { Subject } from "./editor.ts";
import type { Curves } from "./keys.ts";
import type { Spline } from "./sampling.ts";

/** Seconds that a phone takes, as one hears it by itself. */
const PHONE = 0.11;

export function splineOf(session: Session): Spline {
  return (session.setting("spline") ?? session.hello?.spline ?? "soften") as Spline;
}

/** Half-widths of the poses' kernels, where `duration` seconds are 1. */
export function softnessOf(session: Session, duration: number): Map<string, number> {
  return new Map(session.poses.map(({ name, softness }) => [name, softness / duration]));
}

export function pairSubject(session: Session, view: BigramView, duration: number): Subject {
  const [first, second] = view.pair;
  const own = view.setCurves ?? view.standIn;
  const drawn = view.overrideCurves;
  const above = session.target === "overrides";
  return {
    name: `pair ${first} ${second}`,
    domain: { first: 0, last: 1, rests: true },
    curves: inOrder(session, above ? (drawn ?? view.under) : own),
    ghosts: drawn ? inOrder(session, above ? own : drawn) : {},
    poses: session.poseNames(),
    boundary: view.boundary,
    stretches: [
      { label: first, from: 0, to: view.boundary },
      { label: second, from: view.boundary, to: 1 },
    ],
    spline: splineOf(session),
    softness: softnessOf(session, duration),
  };
}

export function phoneSubject(session: Session, view: PhoneView): Subject {
  return {
    name: `phone ${view.phone}`,
    domain: { first: -1, last: 2, rests: false },
    curves: inOrder(session, view.curves),
    ghosts: {},
    poses: session.poseNames(),
    boundary: null,
    stretches: [
      { label: "before", from: -1, to: 0 },
      { label: view.phone, from: 0, to: 1 },
      { label: "after", from: 1, to: 2 },
    ],
    spline: splineOf(session),
    softness: softnessOf(session, PHONE),
  };
}

function inOrder(session: Session, curves: Curves): Curves {
  const known = session.poseNames().filter((name) => curves[name]?.length);
  return Object.fromEntries(known.map((name) => [name, curves[name]]));
}
