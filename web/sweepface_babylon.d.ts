import type {Material} from '@babylonjs/core/Materials/material.js';
import type {Mesh} from '@babylonjs/core/Meshes/mesh.js';
import type {Scene} from '@babylonjs/core/scene.js';
import type {Bytes, Drive, DriveKind, LoadOptions, Pose, ReadonlyPose, Sweepface, Weights} from './sweepface.js';

/** A face in a scene of Babylon.js. Weights are set at any time; whenever the scene is rendered, the face moves on by
 * the time of its animations and the mesh follows. */
export class SweepfaceMesh extends Mesh {
  /** Loads a face from a URL or from bytes, and makes its mesh. */
  static load(source: string | URL | Bytes, scene: Scene, options?: LoadOptions): Promise<SweepfaceMesh>;
  /** Unless a material is given, each part of the face gets a plain one, named as in the source, in a MultiMaterial if
   * there are several. If several meshes show one face, only one of them may let its time pass. */
  constructor(name: string, scene: Scene, face: Sweepface, material?: Material);
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  readonly names: string[];
  readonly eyeCount: number;
  readonly regions: string[];
  /** The current weights, and in `pose` the eyes. */
  readonly weights: Readonly<Weights>;
  weightsIn(region: string): Readonly<Weights>;
  /** Whether time passes with the frames of the scene: true at first. Set it to false where something else advances the
   * face, such as a TimelinePlayer. */
  advancesWithScene: boolean;
  readonly pose: ReadonlyPose | null;
  /** Turns the eyes; null: by the weights of eyeLook targets. */
  look(pose: Pose | null): void;

  /** Sets the named weights at once, everywhere or in one region; the others stay. */
  setWeights(weights: Weights, region?: string): void;
  /** Sets all weights to 0 at once. */
  reset(): void;
  /** Sends weights from where they are to goals, everywhere or in one region. */
  moveTo(goals: Weights, drive?: DriveKind | Drive, region?: string): void;
  /** An impulse: adds to the velocity of a weight (per second), which drag (per second, 8 unless given) then takes away. */
  push(name: string, velocityChange: number, drag?: number): void;
  /** Lets time pass without showing it; returns whether anything still moves or waits to. */
  advance(seconds: number): boolean;
  /** Lets time pass and shows it. The scene calls it before every frame. Returns whether there is something new to draw,
   * or will be in the next frame. */
  update(seconds?: number): boolean;
  /** Gets the face ready to move. Otherwise that happens when it first moves, and takes a few frames. */
  prepare(): void;
  /** Another face of the same file with the same weights, which moves by itself; it shares the material. Without a parent
   * it has that of the original. Children are cloned, too, unless `doNotCloneChildren` is given. */
  clone(name?: string, parent?: Parameters<Mesh['clone']>[1], doNotCloneChildren?: boolean): SweepfaceMesh;
  /** Frees the geometry and the face, and with the last mesh that shows them the materials that the mesh made. */
  dispose(doNotRecurse?: boolean, disposeMaterialAndTextures?: boolean): void;
}
