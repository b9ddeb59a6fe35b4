/** Weights or goals by the names of expressions. */
export type Weights = Record<string, number>;

/** How a weight goes from where it stands, with the velocity it has, to a goal. */
export type DriveKind = 'cut' | 'newton' | 'linear-force' | 'accelerate-brake' | 'spring' | 'bounce';

export interface Drive {
  /** 'spring' unless given. */
  kind?: DriveKind | undefined;
  /** Seconds before it sets out; what still waits when the next comes for the same weight is left out. */
  delay?: number | undefined;
  /** Seconds until it arrives; not for 'cut' and 'spring'. */
  seconds?: number | undefined;
  /** 'accelerate-brake': when the second force takes over, as a fraction. */
  turn?: number | undefined;
  /** 'spring': oscillations a second if there were no damper. */
  frequency?: number | undefined;
  /** 'spring': below 1 it overshoots, above it creeps. */
  damping?: number | undefined;
  /** 'bounce': the share of the speed that is left, in [0, 1 - 1e-9]. */
  restitution?: number | undefined;
}

/** A file in memory; also Node's `Buffer`, and views of shared memory. */
export type Bytes = ArrayBuffer | ArrayBufferView;

/** A `WebAssembly.Module`, where the types of the project know it: those of browsers do. */
type CompiledModule = typeof globalThis extends {WebAssembly: {Module: {prototype: infer Module}}} ? Module : object;
/** Where the WebAssembly module is, if not beside sweepface.js: a text or a `href` is a URL, in a page relative to its
 * base. */
export type ModuleSource = string | {readonly href: string} | Bytes | CompiledModule;

/** A part of the face that is heavier or stiffer than the rest or sets out later: docs/regions.md. */
export interface Region {
  name: string;
  /** How heavy and how stiff it is; the rest is 1. */
  mass?: number | undefined;
  stiffness?: number | undefined;
  /** Seconds by which it sets out later. */
  delay?: number | undefined;
  /** Materials and groups of the source, by name. */
  parts?: readonly string[] | undefined;
  /** Places, each by itself, or joined by a line; model units. */
  points?: readonly (readonly [number, number, number])[] | undefined;
  line?: readonly (readonly [number, number, number])[] | undefined;
  /** Curves of the wireframe, and shares of single nodes, by name or number. */
  curves?: readonly string[] | undefined;
  nodes?: Readonly<Record<string, number>> | undefined;
  /** All of it up to this distance, and from there less and less over so much more. */
  whole?: number | undefined;
  fade?: number | undefined;
  /** 'surface' unless given: distances along the neutral's curves, or straight through the air. */
  over?: 'surface' | 'space' | undefined;
  /** Cuts what fades into so many regions name1, name2 ..., delayed in equal steps up to `delay`. */
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

/** Files that are not packed, `edgeLength`, `error`, `vertices`, `arcs`, `combine`, `eyes` and `regions` load
 * sweepface_full.wasm instead of sweepface.wasm. */
export interface LoadOptions {
  /** 0: the source's own vertices; N: every edge of the source cut into N, up to 64. */
  lod?: number | undefined;
  /** One of these instead of `lod`, as fine as it asks: no curve has a segment longer than `edgeLength`, no edge of
   * a triangle is further than `error` from the surface (both in model units), or the best with so many points. */
  edgeLength?: number | undefined;
  error?: number | undefined;
  vertices?: number | undefined;
  /** What messages call the face. */
  name?: string | undefined;
  /** Targets that turn, the jaw and lids, go on arcs, if the file tells about what they turn. */
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

/** A face that follows its weights. */
export class Sweepface {
  private constructor();

  /** Reads a .sweep file: of a packed one all that the neutral needs, and what targets do when the face first moves.
   * Rejects with the library's own sentence about what is wrong; what no checksum shows of targets is thrown
   * when they are read. */
  static load(bytes: Bytes, options?: LoadOptions): Promise<Sweepface>;

  /** Another face of the same file, at rest; the two share everything but their weights. */
  clone(): Sweepface;

  /** The expressions. */
  readonly names: string[];
  /** The level that was asked for; 0 where a budget was. */
  readonly lod: number;
  /** How far any source vertex may be off in any expression, in model units, not counting what evaluation adds. */
  readonly tolerance: number;
  /** How many targets turn about something that the file tells: what `arcs` is for. */
  readonly turnCount: number;
  /** Vertices up to here are the source's (or, from lod 1 on, the surface's); others repeat one of them. */
  readonly pointCount: number;
  readonly vertexCount: number;
  /** [triangles × 3] vertices, counter-clockwise seen from outside; a new array every time. */
  readonly triangles: Uint32Array;
  /** [vertices × 2] u to the right and v upwards, or null; a new array every time. */
  readonly texcoords: Float32Array | null;
  readonly parts: Part[];
  /** Bytes of WebAssembly memory that the file and all its faces hold. */
  readonly memoryBytes: number;

  /** The regions, first 'rest' if they leave anything; none where the face is of one piece. */
  readonly regions: string[];
  /** The weights as they are; of several regions, those of the first. */
  readonly weights: Weights;
  weightsIn(region: string): Weights;
  /** `weights` as numbers alone, in the order of `names`, which takes less time every frame; a copy. */
  readonly weightValues: Float64Array;
  /** Sets the weights that are named, at once, everywhere or in one region; the others stay. */
  setWeights(weights: Weights, region?: string): void;
  /** All weights to 0, at once. */
  reset(): void;

  /** Sends weights to goals from where they stand, everywhere or in one region; `advance` moves them. */
  moveTo(goals: Weights, drive?: DriveKind | Drive, region?: string): void;
  /** A blow: adds up to 1,000,000 to the velocity of a weight (per second), which drag (per second, 8 unless given) takes
   * away. The weight comes to rest where that leaves it: where it was going, or waited to go, is forgotten. */
  push(name: string, velocityChange: number, drag?: number): void;
  /** Lets seconds pass for the weights in motion; says whether anything goes on moving or waits to. Of less than 0, or
   * more than 1e10 at once, none pass. */
  advance(seconds: number): boolean;

  /** How many eyeballs turn: with the option `eyes`, as many as the face has. */
  readonly eyeCount: number;
  /** How the eyes stand; null, as at the start: by the weights of eyeLook targets. */
  look(pose: Pose | null): void;
  /** What `look` was told last. */
  readonly pose: Pose | null;

  /** Writes three floats a vertex: positions in model units, unit normals. Either may be null. */
  evaluate(positions: Float32Array | Float64Array | null, normals?: Float32Array | Float64Array | null): void;
  /** What a vertex shader evaluates the face from: docs/evaluation.md. */
  shaderTables(tangents?: boolean): {basis: Int16Array; places: Uint32Array; neutral: Float32Array; modes: number};
  /** Writes what changes every frame for it, four integers a mode; returns their factor. */
  shaderModes(out: Int16Array, tangents?: boolean): number;
  /** For vertices behind the points, the point that each repeats. */
  readonly copies: Uint32Array;
  /** Makes ready to move, which else happens when it first does and takes a few frames: reads what targets do, and
   * makes the tables of evaluation. */
  prepare(): void;

  /** Frees the face; it can no longer be used. Memory is given back with the last face of a file. */
  dispose(): void;
}
