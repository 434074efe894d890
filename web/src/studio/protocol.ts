// Made by `python -m lipwright.studio.typescript web/src/studio/protocol.ts`
// from src/lipwright/studio/messages.py; change it there.

/** base64 of little-endian float32 */
export type Packed = string;

/** Draw the curve of one pose in one pair; no keys take the pose out of the pair. */
export interface DrawCurve {
  type: "drawCurve";
  target: "overrides" | "set";
  pair: [string, string];
  pose: string;
  keys: [number, number][] | null;
}

/** Draw all of a pair anew, as when it is pasted. */
export interface DrawPair {
  type: "drawPair";
  target: "overrides" | "set";
  pair: [string, string];
  curves: Record<string, [number, number][]>;
  boundary?: number | null;
  word?: string | null;
}

/** Take a pair out of the target: overrides fall back to the set, the set to a stand-in. */
export interface ClearPair {
  type: "clearPair";
  target: "overrides" | "set";
  pair: [string, string];
}

/** Say where in 0..1 the boundary of a pair's two phones lies. */
export interface MoveMark {
  type: "moveMark";
  target: "overrides" | "set";
  pair: [string, string];
  boundary: number;
}

/** Give a pair another example word. */
export interface NameWord {
  type: "nameWord";
  target: "overrides" | "set";
  pair: [string, string];
  word: string;
}

/** Draw the single-phone curve of a class, which missing pairs are made of. */
export interface DrawPhone {
  type: "drawPhone";
  target: "overrides" | "set";
  phone: string;
  pose: string;
  keys: [number, number][] | null;
}

/** Change one number or choice of the stages; nothing goes back to what it was. */
export interface SetRule {
  type: "setRule";
  target: "overrides" | "set";
  kind: "gain" | "pose" | "setting" | "threshold";
  names: string[];
  field: string;
  value: number | string | null;
}

/** Put a line that was made into the list. */
export interface AddLine {
  type: "addLine";
  line: LineData;
}

/** A line as it is kept: what was said, and when each phone sounds. */
export interface LineData {
  id: string;
  title: string;
  phones: [string, number, number][];
  words: [string, number, number][];
  phoneSet?: string;
  text?: string;
  language?: string;
  source?: string;
  sound?: SoundRef | null;
  notes?: string[];
  edits?: Edit[];
}

/** A sound that is kept: what it is asked for by, and how long it is in seconds. */
export interface SoundRef {
  key: string;
  duration: number;
}

/** One correction of one pose in one phone. */
export interface Edit {
  word: string;
  phone: number;
  pose: string;
  occurrence?: number;
  label?: string;
  gain?: number;
  level?: number | null;
  hold?: number;
  keys?: [number, number][] | null;
  unlocked?: boolean;
}

/** Take a line out of the list. */
export interface RemoveLine {
  type: "removeLine";
  line: string;
}

/** Move where one phone ends and the next begins. */
export interface MoveBoundary {
  type: "moveBoundary";
  line: string;
  phone: number;
  time: number;
}

/** Correct one pose in one phone of a line; an edit of the same place is replaced. */
export interface PutEdit {
  type: "putEdit";
  line: string;
  edit: Edit;
}

/** Take an edit of a line away, found or lost. */
export interface RemoveEdit {
  type: "removeEdit";
  line: string;
  edit: Edit;
}

/** The first word of a page; answered by :class:`Hello`. */
export interface Start {
  type: "start";
  id?: number;
  session?: string;
}

/** Change something; answered by :class:`Changed`, to every page. */
export interface EditRequest {
  type: "edit";
  id?: number;
  change: Change;
  merge?: string;
}

/** Take back steps; answered by :class:`Changed`. */
export interface Undo {
  type: "undo";
  id?: number;
  steps?: number;
}

/** Do steps again; answered by :class:`Changed`. */
export interface Redo {
  type: "redo";
  id?: number;
  steps?: number;
}

/** Take the draft that :class:`Hello` offers, or throw it away; answered by Hello. */
export interface Draft {
  type: "draft";
  id?: number;
  take: boolean;
}

/** Say what the page shows: all of it is sent now, and again when it changes. */
export interface Watch {
  type: "watch";
  id?: number;
  pair?: [string, string] | null;
  phone?: string;
  line?: string;
  start?: number;
  end?: number;
  stages?: ("constrained" | "limited" | "placed" | "smoothed" | "stitched")[];
  other?: Variant | null;
}

/** One of two versions that are held side by side. */
export interface Variant {
  kind?: "character" | "engine" | "now" | "opened" | "preset" | "set" | "unedited";
  value?: string;
}

/** Speak a text as a new line, or a ``line`` anew; answered by :class:`Made`. */
export interface Say {
  type: "say";
  id?: number;
  text: string;
  voice?: string;
  speed?: number;
  line?: string;
}

/** Make a line of a sound that was sent; answered by :class:`Made`. */
export interface Hear {
  type: "hear";
  id?: number;
  sound: string;
  title?: string;
  text?: string;
  labels?: string;
  labelsName?: string;
  language?: string;
  byEar?: boolean;
  line?: string;
}

/** Speak a pair's example word; answered by :class:`ExampleView`. It is no step of undo. */
export interface Example {
  type: "example";
  id?: number;
  pair: [string, string];
}

/** Ask why a control of a line has its value at an instant; answered by WhyView. */
export interface Why {
  type: "why";
  id?: number;
  line: string;
  control: string;
  time: number;
}

/** Ask which pairs are needed; answered by :class:`CoverageView`, and colours the matrix. */
export interface CoverageRequest {
  type: "coverage";
  id?: number;
  text?: string;
  every?: boolean;
}

/** Choose who speaks: a built-in name, or the key of a model that was sent. */
export interface ChooseCharacter {
  type: "character";
  id?: number;
  name: string;
}

/** Ask how the face holds some poses; answered by :class:`PoseView`. */
export interface TryPose {
  type: "pose";
  id?: number;
  weights: Record<string, number>;
}

/** Ask what saving would change; answered by :class:`PreviewView`. */
export interface Preview {
  type: "preview";
  id?: number;
  document: "edits" | "labels" | "overrides" | "set";
  line?: string;
  name?: string;
}

/** Write what was previewed; answered by :class:`Saved`, to every page. */
export interface Save {
  type: "save";
  id?: number;
  document: "edits" | "labels" | "overrides" | "set";
  digest: string;
  line?: string;
  name?: string;
}

/** Take a file as it is on disk now, and lay our changes over it; answered by Hello. */
export interface Reread {
  type: "reread";
  id?: number;
  document: "edits" | "labels" | "overrides" | "set";
  line?: string;
  keep?: boolean;
}

/** All that is open. */
export interface Hello {
  type: "hello";
  id: number;
  version: string;
  session: string;
  revision: number;
  setName: string;
  setAbout: string;
  preset: string;
  presets: string[];
  target: "overrides" | "set";
  spline: string;
  classes: ClassInfo[];
  poses: PoseInfo[];
  rules: Rule[];
  cells: Cell[];
  lines: LineName[];
  files: FileInfo[];
  history: History;
  character: CharacterView;
  characters: string[];
  sets: string[];
  voices: string[];
  engines: string[];
  draft: DraftInfo | null;
}

/** A class of phones, with a word in which it sounds. */
export interface ClassInfo {
  label: string;
  word: string;
}

/** A pose of the set, as its stages know it. */
export interface PoseInfo {
  name: string;
  priority: number;
  meets: "cut" | "widen";
  limit: number;
  window: number;
  softness: number;
}

/** A live control: what :class:`~lipwright.studio.changes.SetRule` changes. */
export interface Rule {
  kind: "gain" | "pose" | "setting" | "threshold";
  names: string[];
  field: string;
  value: number | string;
  default: number | string;
  opened: number | string;
  about: string;
  unit: string;
  least: number;
  most: number;
  choices: string[];
}

/** A pair in the matrix. */
export interface Cell {
  pair: [string, string];
  state: "drawn" | "no curve" | "stand-in";
  overridden: boolean;
  changed: boolean;
  need: number;
  edits: number;
  word: string;
}

/** A line in the list. */
export interface LineName {
  id: string;
  title: string;
  duration: number;
  edits: number;
  lost: number;
}

/** A document that can be saved; no ``path`` where it is still to be named. */
export interface FileInfo {
  document: "edits" | "labels" | "overrides" | "set";
  line: string;
  path: string;
  suggested: string;
  dirty: boolean;
  about: string;
}

/** What can be taken back and done again, in words; nothing where there is nothing. */
export interface History {
  undo: string;
  redo: string;
  undoSteps: number;
  redoSteps: number;
}

/** Who speaks: ``model`` is the GLB's address; ``version`` ``"b"`` for the second one. */
export interface CharacterView {
  type: "character";
  id: number;
  version: "a" | "b";
  name: string;
  title: string;
  model: string;
  backwards: boolean;
  joints: Joint[];
  known: string[];
  notes: string[];
}

/** A channel that turns a joint: its node, axis, and degrees at 1. */
export interface Joint {
  channel: string;
  node: number;
  axis: [number, number, number];
  degrees: number;
}

/** What a studio that ended early left behind. */
export interface DraftInfo {
  steps: number;
  savedAt: string;
  summary: string;
}

/** What became different: ``cells`` only those; the others whole, or None if the same. */
export interface Changed {
  type: "changed";
  id: number;
  revision: number;
  history: History;
  cells: Cell[];
  rules: Rule[] | null;
  poses: PoseInfo[] | null;
  lines: LineName[] | null;
  files: FileInfo[] | null;
}

/** A pair as it is drawn. */
export interface BigramView {
  type: "bigram";
  id: number;
  revision: number;
  pair: [string, string];
  state: "drawn" | "no curve" | "stand-in";
  source: string;
  boundary: number;
  word: string;
  curves: Record<string, [number, number][]>;
  setCurves: Record<string, [number, number][]> | null;
  overrideCurves: Record<string, [number, number][]> | null;
  under: Record<string, [number, number][]>;
  standIn: Record<string, [number, number][]>;
  starts: Record<string, [number, number][]>;
}

/** The single-phone curve of a class. */
export interface PhoneView {
  type: "phone";
  id: number;
  revision: number;
  phone: string;
  word: string;
  curves: Record<string, [number, number][]>;
  overridden: boolean;
}

/** A line, without its motion; ``sound`` is the address of its WAV, nothing where silent. */
export interface LineView {
  type: "line";
  id: number;
  revision: number;
  line: string;
  title: string;
  text: string;
  source: string;
  duration: number;
  start: number;
  end: number;
  words: Span[];
  phones: Span[];
  classes: ClassSpan[];
  pairs: PairSpan[];
  edits: EditView[];
  notes: string[];
  sound: string;
}

/** A label in time, seconds. */
export interface Span {
  label: string;
  start: number;
  end: number;
}

/** A class in time; ``phone`` is which of the line's phones it is, -1 for a silence. */
export interface ClassSpan {
  label: string;
  start: number;
  end: number;
  phone: number;
  word: string;
  wordNumber: number;
  phoneInWord: number;
  occurrence: number;
}

/** A pair of a line: ``phone`` is the number of its first phone among the classes. */
export interface PairSpan {
  pair: [string, string];
  first: number;
  boundary: number;
  last: number;
}

/** An edit of a line, and where it acts; a lost one has no place. */
export interface EditView {
  edit: Edit;
  name: string;
  lost: boolean;
  start: number;
  end: number;
}

/** What became different in a line whose rest was sent before: so that a drag stays light. */
export interface LinePart {
  type: "line part";
  id: number;
  revision: number;
  line: string;
  duration: number;
  start: number;
  end: number;
  words: SpanSplice;
  phones: SpanSplice;
  classes: ClassSplice;
  pairs: PairSplice;
  edits: EditView[];
}

/** In a list of spans, from place ``at`` on, ``gone`` of them give way to ``new`` ones. */
export interface SpanSplice {
  at: number;
  gone: number;
  new: Span[];
}

/** The same of classes. */
export interface ClassSplice {
  at: number;
  gone: number;
  new: ClassSpan[];
}

/** The same of pairs. */
export interface PairSplice {
  at: number;
  gone: number;
  new: PairSpan[];
}

/** A line's waveform: least and greatest sample by turns; sent once to each page. */
export interface PeaksView {
  type: "peaks";
  id: number;
  line: string;
  sound: string;
  peaks: Packed;
  perSecond: number;
}

/** How a line moves: the curves of its controls, and the channels of the character's rig. */
export interface MotionView {
  type: "motion";
  id: number;
  revision: number;
  line: string;
  version: "a" | "b";
  controls: Frames;
  channels: Frames;
  stages: Stage[];
  character: string;
  notes: string[];
  milliseconds: number;
}

/** Values over time: frame ``k`` is at ``start + k / rate``; names vary fastest. */
export interface Frames {
  names: string[];
  rate: number;
  start: number;
  count: number;
  values: Packed;
}

/** One stage's curves. */
export interface Stage {
  name: "constrained" | "limited" | "placed" | "smoothed" | "stitched";
  curves: StageCurve[];
}

/** Keys of one control after one stage, seconds and weights. */
export interface StageCurve {
  control: string;
  times: Packed;
  values: Packed;
  breaks: number[];
  pairs: number[];
}

/** The rig's channels for poses that were tried. */
export interface PoseView {
  type: "pose";
  id: number;
  channels: Record<string, number>;
}

/** A line that was made. */
export interface Made {
  type: "made";
  id: number;
  line: string;
}

/** How far long work is, 0..1. */
export interface Progress {
  type: "progress";
  id: number;
  share: number;
  what: string;
}

/** An example: ``line`` can be watched as others can; loop ``start`` to ``end``. */
export interface ExampleView {
  type: "example";
  id: number;
  pair: [string, string];
  word: string;
  line: string;
  start: number;
  end: number;
}

/** Why a control has its value. */
export interface WhyView {
  type: "why";
  id: number;
  line: string;
  control: string;
  time: number;
  phone: string;
  word: string;
  value: number;
  origins: OriginView[];
  reasons: ReasonView[];
  edits: string[];
  alone: number | null;
  text: string;
}

/** A pair with a curve at the instant, the one that won first; ``keys`` in its 0..1. */
export interface OriginView {
  pair: [string, string];
  source: string;
  start: number;
  end: number;
  value: number;
  keys: [number, number][];
  override: string;
  own: number | null;
}

/** What one stage did. */
export interface ReasonView {
  stage: string;
  before: number;
  after: number;
  text: string;
}

/** Which pairs are needed, most first; ``missing`` those to draw, worst first. */
export interface CoverageView {
  type: "coverage";
  id: number;
  source: string;
  share: number;
  lines: number;
  needed: NeedView[];
  missing: NeedView[];
  edited: EditedPair[];
  notes: string[];
  cells: Cell[];
}

/** A pair that is needed; ``covered`` is the share that is drawn once this one is. */
export interface NeedView {
  pair: [string, string];
  amount: number;
  share: number;
  state: "drawn" | "no curve" | "stand-in";
  word: string;
  covered: number;
}

/** A pair that lines' edits correct again and again. */
export interface EditedPair {
  pair: [string, string];
  edits: number;
  lines: number;
}

/** What saving would do to a file, as unified diffs. */
export interface PreviewView {
  type: "preview";
  id: number;
  document: "edits" | "labels" | "overrides" | "set";
  line: string;
  path: string;
  isNew: boolean;
  diff: string;
  theirs: string;
  both: string[];
  refused: string;
  digest: string;
}

/** A file was written. */
export interface Saved {
  type: "saved";
  id: number;
  document: "edits" | "labels" | "overrides" | "set";
  line: string;
  path: string;
  files: FileInfo[];
}

/** All that a page watches has been sent. */
export interface Watched {
  type: "watched";
  id: number;
  revision: number;
}

/** What was asked could not be done, in one line; nothing has changed. */
export interface Failed {
  type: "failed";
  id: number;
  error: string;
}

export type Change =
  | DrawCurve
  | DrawPair
  | ClearPair
  | MoveMark
  | NameWord
  | DrawPhone
  | SetRule
  | AddLine
  | RemoveLine
  | MoveBoundary
  | PutEdit
  | RemoveEdit;

export type Request =
  | Start
  | EditRequest
  | Undo
  | Redo
  | Draft
  | Watch
  | Say
  | Hear
  | Example
  | Why
  | CoverageRequest
  | ChooseCharacter
  | TryPose
  | Preview
  | Save
  | Reread;

export type Answer =
  | Hello
  | Changed
  | BigramView
  | PhoneView
  | LineView
  | LinePart
  | PeaksView
  | MotionView
  | CharacterView
  | PoseView
  | Made
  | Progress
  | ExampleView
  | WhyView
  | CoverageView
  | PreviewView
  | Saved
  | Watched
  | Failed;
