/** Bytes of a file, or a text. They are copied, not taken. */
export type FileContent = ArrayBuffer | ArrayBufferView | Blob | string;

/** Files by their names, which may have folders: 'expressions/jawOpen.obj'. */
export type Files = Record<string, FileContent>;

export interface Progress {
  /** How much of the work is done, from 0 to 1. */
  share: number;
  /** What is being done, such as 'fitting'. */
  what: string;
}

export interface RunOptions {
  /** Called some times a second; for small models perhaps only once. */
  onProgress?: (progress: Progress) => void;
  /** Ends the work: the promise is then rejected with the signal's reason. */
  signal?: AbortSignal;
  /** sweepface_tool.wasm, where it is not beside this file: its URL, its bytes, or compiled. */
  wasm?: URL | string | BufferSource | WebAssembly.Module;
}

export interface Ran {
  /** 0 if all went well. */
  code: number;
  /** What the tool printed. */
  output: string;
  /** Its errors and warnings, a line each. */
  errors: string;
  /** The files that it wrote, by name: 'head.obj', or for a folder 'out/neutral.obj'. */
  files: Record<string, Uint8Array<ArrayBuffer>>;
}

/**
 * Runs the tool in a worker, on files in memory: `await runTool(['info', 'face.sweep'], {files: {'face.sweep': bytes}})`.
 * docs/commands.md tells the commands. Fails only where the tool could not run.
 */
export function runTool(args: readonly (string | number)[], options?: RunOptions & {files?: Files}): Promise<Ran>;

/** The options of `sweepface convert`; docs/commands.md tells more. */
export interface ConvertOptions extends RunOptions {
  /** The largest distance between a vertex and the surface, in the mesh's units; 0.02 % of the face's size if not given. */
  tolerance?: number;
  /** Spend the tolerance on the file's size: about a hundredth of the bytes, but more time. */
  pack?: boolean;
  /** Pack, and find the smallest tolerance whose file takes at most so many bytes. */
  maxBytes?: number;
  /** The meshes that are the face; all that have morph targets if not given. */
  mesh?: string | readonly string[];
  /** What to leave out of the file. */
  strip?: readonly ('order' | 'uv' | 'groups' | 'scene')[];
  /** Leave out what the model has besides the face. */
  bare?: boolean;
  /** Levels of subdivision, 1 to 5, of meshes that are cages. */
  subdivide?: number;
  /** Aim at normals within this angle of the mesh's, in degrees. */
  normalLimit?: number;
  /** With pack or maxBytes: the largest angle of normals, in degrees, as the root mean square. */
  normalTolerance?: number;
  /** With pack or maxBytes: bits of texture coordinates, 8 to 16. */
  uvBits?: number;
  /** Store what expressions turn about. */
  arcs?: boolean;
  /** Whether to search for shape parameters, which takes longer; true if not given. */
  shapes?: boolean;
}

export interface Converted {
  /** The .sweep file. */
  bytes: Uint8Array<ArrayBuffer>;
  /** What `sweepface convert --json` reports. */
  report: {patches: number, vertices: number, targets: number, tolerance: number, worstDistance: number, bytes: number,
           [name: string]: unknown};
  warnings: string[];
}

/**
 * Converts a model: a .glb or .vrm, as bytes or as a File, or files of which the first is the .gltf, or the neutral as .obj or .ply
 * with its expressions after it. Fails with the tool's sentence where it cannot.
 */
export function convert(model: ArrayBuffer | ArrayBufferView | Blob | Files, options?: ConvertOptions): Promise<Converted>;
