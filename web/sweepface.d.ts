/** Weights or goals by the names of expressions. */
export type Weights = Record<string, number>;

/** How a weight moves to a goal from its current position and velocity. */
export type DriveKind = 'cut' | 'newton' | 'linear-force' | 'accelerate-brake' | 'spring' | 'bounce';

export interface Drive {
  /** 'spring' unless given. */
  kind?: DriveKind | undefined;
  /** Seconds before it sets out (0 unless given); a drive that still waits is dropped when the next comes for the same weight. */
  delay?: number | undefined;
  /** Seconds until it arrives, 'bounce': until it first hits (0.3 unless given); not for 'cut' and 'spring'. */
  seconds?: number | undefined;
  /** 'accelerate-brake': when the second force takes over, as a fraction of `seconds` (0.5 unless given). */
  turn?: number | undefined;
  /** 'spring': oscillations a second without the damper (2 unless given). */
  frequency?: number | undefined;
  /** 'spring': below 1 it overshoots, above 1 it creeps (1 unless given). */
  damping?: number | undefined;
  /** 'bounce': the share of the speed kept at each bounce, in [0, 1 - 1e-9] (0.4 unless given). */
  restitution?: number | undefined;
}

/** A file in memory; also Node's `Buffer`, and views of shared memory. */
export type Bytes = ArrayBuffer | ArrayBufferView;

/** A `WebAssembly.Module`, if the project's types declare it, as those of browsers do. */
type CompiledModule = typeof globalThis extends {WebAssembly: {Module: {prototype: infer Module}}} ? Module : object;
/** Where the WebAssembly module is, if not beside sweepface.js. A string or `href` is a URL, in a page relative to its
 * base. */
export type ModuleSource = string | {readonly href: string} | Bytes | CompiledModule;

/** A part of the face that is heavier or stiffer than the rest or sets out later: docs/regions.md. */
export interface Region {
  name: string;
  /** How heavy and how stiff it is, relative to the rest (1). */
  mass?: number | undefined;
  stiffness?: number | undefined;
  /** Seconds by which it sets out later than the rest. */
  delay?: number | undefined;
  /** Materials and groups of the source, by name. */
  parts?: readonly string[] | undefined;
  /** Separate places, or places joined by a line; model units. */
  points?: readonly (readonly [number, number, number])[] | undefined;
  line?: readonly (readonly [number, number, number])[] | undefined;
  /** Curves of the wireframe, and shares of single nodes, by name or number. */
  curves?: readonly string[] | undefined;
  nodes?: Readonly<Record<string, number>> | undefined;
  /** The region takes everything up to the distance `whole`, then less and less over `fade` more. */
  whole?: number | undefined;
  fade?: number | undefined;
  /** 'surface' unless given: distances along the neutral's curves; 'space': straight through space. */
  over?: 'surface' | 'space' | undefined;
  /** Cuts the fading part into this many regions, name1, name2 ..., delayed in equal steps up to `delay`. */
  bands?: number | undefined;
}

/** Radians: yaw to the face's left, pitch down. */
export interface Look {
  yaw?: number | undefined;
  pitch?: number | undefined;
  /** As clips have it; eyes do not use it. */
  roll?: number | undefined;
}

/** How the eyes stand. */
export interface Pose {
  leftEye?: Look | undefined;
  rightEye?: Look | undefined;
}

/** A pose to be read: `look` sets another. */
export interface ReadonlyPose {
  readonly leftEye?: Readonly<NonNullable<Pose['leftEye']>>;
  readonly rightEye?: Readonly<NonNullable<Pose['rightEye']>>;
}

/** Files that are not packed, `edgeLength`, `error`, `vertices`, `arcs`, `combine`, `eyes` and `regions` load
 * sweepface_full.wasm instead of sweepface.wasm. */
export interface LoadOptions {
  /** 0: the source's own vertices; N: every edge of the source cut into N, up to 64 and
   * 16,777,216 vertices. */
  lod?: number | undefined;
  /** One of these instead of `lod`, as fine as it demands: no curve has a segment longer than `edgeLength`, no edge of
   * a triangle is further than `error` from the surface (both in model units), or the best with at most `vertices`
   * points. */
  edgeLength?: number | undefined;
  error?: number | undefined;
  vertices?: number | undefined;
  /** What messages call the face. */
  name?: string | undefined;
  /** Targets that turn (the jaw, lids) move on arcs, if the file says what they turn about. */
  arcs?: boolean | undefined;
  /** `A_B` goes by the product of A and B, `A_50` stands in for A at 0.5. */
  combine?: boolean | undefined;
  /** Eyeballs turn rigidly about their centres. */
  eyes?: boolean | undefined;
  /** Divides the face. */
  regions?: readonly Region[] | undefined;
  wasm?: ModuleSource | undefined;
}

/** Triangles of one material, as a range of `triangles`. */
export interface Part {
  /** Its name in the source; '' if it had none. */
  material: string;
  start: number;
  count: number;
}

export interface Sweepface extends Moved {}

/** A face that follows its weights. */
export class Sweepface {
  private constructor();

  /** Reads a .sweep file: of a packed one first all that the neutral needs; what targets do is read when the face first
   * moves. Rejects with the library's own sentence about what is wrong. Faults in the targets that no checksum shows
   * are thrown when targets are read. */
  static load(bytes: Bytes, options?: LoadOptions): Promise<Sweepface>;

  /** Another face of the same file, at rest; the two share everything but their weights. */
  clone(): Sweepface;

  /** The level that was asked for; 0 if a budget was. */
  readonly lod: number;
  /** How far any source vertex may be off in any expression, in model units, not counting what evaluation adds. */
  readonly tolerance: number;
  /** The number of targets for which the file says what they turn about: those that `arcs` affects. */
  readonly turnCount: number;
  /** Vertices below this index are the source's (or, from lod 1 on, the surface's); the others repeat one of them. */
  readonly pointCount: number;
  readonly vertexCount: number;
  /** [triangles × 3] vertices, counter-clockwise seen from outside; a new array every time. */
  readonly triangles: Uint32Array;
  /** [vertices × 2] u to the right and v upwards, or null; a new array every time. */
  readonly texcoords: Float32Array | null;
  readonly parts: Part[];
  /** Bytes of WebAssembly memory that the file and all its faces hold. */
  readonly memoryBytes: number;

  /** A copy of `weights` as numbers in the order of `names`: faster if used every frame. */
  readonly weightValues: Float64Array;
  /** Writes three floats a vertex: positions in model units, unit normals. Either may be null. */
  evaluate(positions: Float32Array | Float64Array | null, normals?: Float32Array | Float64Array | null): void;
  /** The tables from which a vertex shader evaluates the face: docs/evaluation.md. */
  shaderTables(tangents?: boolean): {basis: Int16Array; places: Uint32Array; neutral: Float32Array; modes: number};
  /** Writes what changes for such a shader every frame, four integers a mode; returns their factor. */
  shaderModes(out: Int16Array, tangents?: boolean): number;
  /** For each vertex after the points, the point that it repeats. */
  readonly copies: Uint32Array;

  /** Frees the face; it can no longer be used. Memory is given back with the last face of a file. */
  dispose(): void;
}

/** What a face does, and a mesh with its face. */
export interface Moved {
  /** The expressions. */
  readonly names: string[];
  /** The regions, first 'rest' if they leave anything; empty if the face is not divided. */
  readonly regions: string[];
  /** The current weights; of several regions, those of the first. */
  readonly weights: Readonly<Weights>;
  weightsIn(region: string): Readonly<Weights>;
  /** Sets the named weights at once, everywhere or in one region; the others stay. */
  setWeights(weights: Weights, region?: string): void;
  /** Sets all weights to 0 at once. */
  reset(): void;

  /** Sends weights from where they are to goals, everywhere or in one region; `advance` moves them. */
  moveTo(goals: Weights, drive?: DriveKind | Drive, region?: string): void;
  /** An impulse: adds up to 1,000,000 to the velocity of a weight (per second), which drag (per second, 8 unless given)
   * then takes away. The weight comes to rest wherever that leaves it: earlier goals, waiting ones included, are
   * forgotten. */
  push(name: string, velocityChange: number, drag?: number): void;
  /** Lets time pass for the weights in motion; returns whether anything still moves or waits to. No time passes if
   * `seconds` is less than 0 or more than 1e10. */
  advance(seconds: number): boolean;

  /** How many eyeballs turn: with the option `eyes`, as many as the face has. */
  readonly eyeCount: number;
  /** Turns the eyes; null, as at the start: by the weights of eyeLook targets. */
  look(pose: Pose | null): void;
  /** The pose last given to `look`. */
  readonly pose: ReadonlyPose | null;
  /** Gets the face ready to move: reads what targets do, and builds the tables for evaluation. Otherwise that happens
   * when the face first moves, and takes a few frames. */
  prepare(): void;
}
