import type {Bytes, Drive, Region, Sweepface, Weights} from './sweepface.js';

/** A face, or a mesh of sweepface/three, sweepface/gpu, sweepface/webgpu or sweepface/babylon, or the face of a scene. */
export type Playable = Pick<Sweepface, 'names' | 'eyeCount' | 'setWeights' | 'moveTo' | 'advance' | 'look'> &
  Partial<Pick<Sweepface, 'regions'>>;

/** Which target each name of a clip drives. */
export interface Match {
  /** [names] indices of the targets. */
  targets: number[][];
  /** Names of the clip that drive nothing. */
  unmatched: string[];
  /** Targets that nothing drives. */
  undriven: string[];
}
export function matchNames(names: readonly string[], targets: readonly string[]): Match;

/** How the one-euro filter trades noise for lag, in hertz. */
export interface OneEuro {
  /** At rest: lower removes more noise. 1 unless given. */
  cutoff?: number | undefined;
  /** Per unit of speed: higher follows quick moves more closely. 8 unless given. */
  speedGain?: number | undefined;
  /** Of the speed's own filter: lower misses movement to and fro. 5 unless given. */
  speedCutoff?: number | undefined;
}

/** Which targets names of a clip drive, and how much; null: none. If several drive one target, their sum counts. */
export type NameMap = Readonly<Record<string, string | readonly string[] | Readonly<Record<string, number>> | null>>;

type Floats = Float32Array | Float64Array;

/** Weights over time; all numbers are finite. */
export class Clip<Numbers extends Floats = Floats> {
  constructor(names: string[], times: Floats, weights: Numbers);
  readonly names: string[];
  /** [frames] seconds, never decreasing. */
  readonly times: Floats;
  /** [frames × names] */
  readonly weights: Numbers;
  readonly seconds: number;
  /** What was repaired or may be wrong in the file that it was read from, in sentences. */
  readonly warnings: string[];
  /** The weights at `seconds` after the first frame, linear between frames and held at the ends. */
  at<Out extends Floats = Float64Array>(seconds: number, out?: Out): Out;
  /** The clip without a tracker's noise; nothing lags. */
  smooth(settings?: OneEuro): Clip<Numbers>;
  /** The clip with the names of the targets in a map; names that are not in the map stay. */
  renamed(map: NameMap): Clip<Float64Array>;
}

export interface ReadOptions {
  /** What messages call the clip or the timeline. */
  name?: string | undefined;
}

/** A capture: a CSV of Live Link Face, or a JSON of Audio2Face or MediaPipe. Throws a sentence about what is wrong. */
export function readClip(source: string | Bytes, options?: ReadOptions & {framesPerSecond?: number | undefined}):
  Clip<Float64Array>;

/** Plays a clip on a face, in all regions alike: their mass, stiffness and delay only affect `moveTo` and timelines. */
export class ClipPlayer<Face extends Playable = Playable> {
  constructor(face: Face, clip: Clip);
  readonly face: Face;
  readonly clip: Clip;
  readonly match: Match;
  readonly seconds: number;
  /** Sets the weights at a time. Turns the eyes by the clip's angles, or else by its eyeLook weights, in place of an
   * earlier `look`. Returns the angles of the head in radians, if the clip has them. */
  seek(seconds: number): {yaw: number; pitch: number; roll: number} | null;
}

export interface TimelineEvent {
  at: number;
  goals: Weights;
  /** Whether all other weights of the timeline go to 0. */
  others: boolean;
  drive: Drive;
  region?: string | undefined;
}

export interface Timeline {
  seconds: number;
  loops: number;
  /** In any order; of two at one time the later in the list counts. */
  events: TimelineEvent[];
  /** For the options of Sweepface.load. */
  regions?: Region[] | undefined;
}

/** A timeline from its JSON (docs/clips.md). Throws a sentence about what is wrong. */
export function readTimeline(source: string | Bytes, options?: ReadOptions): Timeline;

/** Plays a timeline on a face, which must have the regions that it moves. What it says about the eyes replaces an
 * earlier `look`. */
export class TimelinePlayer<Face extends Playable = Playable> {
  constructor(face: Face, timeline: Timeline);
  readonly face: Face;
  readonly timeline: Timeline;
  readonly match: Match;
  readonly seconds: number;
  /** Lets time pass (none if `seconds` is more than 10¹⁰); returns whether anything still moves or is yet to come. Then
   * show a mesh by `update()` without seconds, which would pass twice. */
  advance(seconds: number): boolean;
  /** Starts again from the beginning, with the face as it stands; what moves or waits goes on, unless the face is
   * reset. */
  restart(): void;
}
