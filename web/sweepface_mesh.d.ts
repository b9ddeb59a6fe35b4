import type {BufferGeometry, Material, Mesh} from 'three';
import type {Drive, DriveKind, Pose, Sweepface, Weights} from './sweepface.js';

/** A face in a scene. Weights are set at any time; `update` brings them to the screen. */
export class FaceMesh extends Mesh {
  /** Materials: one a part of the face; plain ones, named as in the source, unless given. */
  protected constructor(face: Sweepface, geometry: BufferGeometry, materials?: Material | Material[]);
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  readonly names: string[];
  readonly eyeCount: number;
  readonly regions: string[];
  /** How the eyes stand; null: by the weights of eyeLook targets. */
  look(pose: Pose | null): void;

  /** Sets the weights that are named, at once, everywhere or in one region; the others stay. */
  setWeights(weights: Weights, region?: string): void;
  /** All weights to 0, at once. */
  reset(): void;
  /** Sends weights to goals from where they stand, everywhere or in one region; `update` moves them. */
  moveTo(goals: Weights, drive?: DriveKind | Drive, region?: string): void;
  /** A blow: adds to the velocity of a weight (per second), which drag (per second) takes away. */
  push(name: string, velocityChange: number, drag?: number): void;
  /** Lets seconds pass without showing it; says whether anything goes on moving. Of less than 0, or more than 1e10 at
   * once, none pass. */
  advance(seconds: number): boolean;
  /** Call it once a frame with the seconds since the last, as `advance` takes them; costs nothing where nothing moves,
   * and does nothing once the mesh is disposed of. */
  update(seconds?: number): void;
  /** Another face of the same file with the same weights, which moves by itself. Materials are shared, but of a
   * SweepfaceGpuMesh, whose are clones. */
  clone(recursive?: boolean): this;
  /** Frees geometry, materials and the face. */
  dispose(): void;
}
