/** What a test, or another script on the page, may ask of the studio: `window.studio`. */

export interface StudioApi {
  /** Fulfilled once all that is open is known and the face is on the stage. */
  ready: Promise<void>;
  /** Fulfilled once nothing waits for an answer and what came is drawn. */
  idle(): Promise<void>;
  seek(seconds: number): void;
  time(): number;
  play(): void;
  pause(): void;
  playing(): boolean;
  /** Whether the audio graph runs: sound leaves the loudspeaker now. */
  sounding(): boolean;
  setView(name: string): void;
  setIdle(on: boolean): void;
  /** What the rig of the face holds now. */
  morphs(): Record<string, number>;
  positions(): Record<string, number[]>;
  /** The controls of the line at an instant, as the page samples them. */
  controls(seconds: number): Record<string, number>;
  /** The pair that is open, its curves as they are drawn now, and the chosen pose. */
  editor(): {
    pair: [string, string] | null;
    pose: string;
    curves: Record<string, [number, number][]>;
  };
  /** Where a key, an instant of a control's curve, or the edge after a phone is on the page. */
  keyAt(pose: string, index: number): { x: number; y: number } | null;
  curveAt(control: string, seconds: number): { x: number; y: number } | null;
  edgeAt(phone: number): { x: number; y: number } | null;
  /** Milliseconds from each of the last edits to the picture that shows its motion. */
  latencies(): number[];
  /** Pictures per second while playing, over the last second. */
  pictures(): number;
}

declare global {
  interface Window {
    studio: StudioApi;
  }
}
