import type {Material} from '@babylonjs/core/Materials/material.js';
import type {Mesh} from '@babylonjs/core/Meshes/mesh.js';
import type {Scene} from '@babylonjs/core/scene.js';
import type {Bytes, LoadOptions, Moved, Sweepface} from './sweepface.js';

export interface SweepfaceMesh extends Moved {}

/** A face in a scene of Babylon.js. Weights are set at any time; whenever the scene is rendered, the face moves on by
 * the time of its animations and the mesh follows. */
export class SweepfaceMesh extends Mesh {
  /** Loads a face from a URL or from bytes, and makes its mesh in a scene: the last one that was made unless given.
   * `load` may be loadInWorker of sweepface/worker. */
  static load<M extends SweepfaceMesh>(
    this: new (name: string, scene: any, face: Sweepface) => M, source: string | URL | Bytes, scene?: Scene | null,
    options?: LoadOptions & {load?: typeof Sweepface.load | undefined}): Promise<M>;
  /** Without a scene it belongs to the last one that was made. Unless a material is given, each part of the face gets a
   * plain one, named as in the source, in a MultiMaterial if there are several. Every mesh needs a face of its own, which
   * clone() makes at little cost: it frees the face with itself. */
  constructor(name: string, scene: Scene | null | undefined, face: Sweepface, material?: Material);
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  /** Whether time passes with the frames of the scene: true at first. Set it to false where something else advances the
   * face, such as a TimelinePlayer. */
  advancesWithScene: boolean;
  /** Lets time pass and shows it. The scene calls it before every frame. Returns whether there is something new to draw,
   * or will be in the next frame. */
  update(seconds?: number): boolean;
  /** Another face of the same file with the same weights, which moves by itself; it shares the material. Without a parent
   * it has that of the original. Children are cloned, too, unless `doNotCloneChildren` is given. */
  clone(name?: string, parent?: Parameters<Mesh['clone']>[1], doNotCloneChildren?: boolean): SweepfaceMesh;
  /** Frees the geometry and the face, and with the last mesh that shows them the materials that the mesh made. */
  dispose(doNotRecurse?: boolean, disposeMaterialAndTextures?: boolean): void;
}
