import type {BufferGeometry, Material, Mesh, MeshStandardMaterial, Object3D, Vector3} from 'three';
import type {Drive, DriveKind, Pose, Sweepface, Weights} from './sweepface.js';

/** A face in a scene. Weights are set at any time; `update` brings them to the screen. */
export class FaceMesh<Materials extends Material | Material[] = MeshStandardMaterial[]>
    extends Mesh<BufferGeometry, Materials> {
  /** Materials: one for all, or one a part of the face; plain ones, named as in the source, unless given. Of several meshes
   * that show one face only one may let its time pass. */
  protected constructor(face: Sweepface, geometry: BufferGeometry, materials?: Materials);
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  readonly names: string[];
  readonly eyeCount: number;
  readonly regions: string[];
  /** Weights and eyes as they are. */
  readonly weights: Weights;
  /** The weights by the place of their names, as other meshes have them, of several regions those of the first. A number
   * that is set to another one here counts from the next `update` on, in all regions; what is no number changes nothing. */
  morphTargetInfluences: number[];
  morphTargetDictionary: Record<string, number>;
  weightsIn(region: string): Weights;
  readonly pose: Pose | null;
  /** How the eyes stand; null: by the weights of eyeLook targets. */
  look(pose: Pose | null): void;

  /** Sets the weights that are named, at once, everywhere or in one region; the others stay. */
  setWeights(weights: Weights, region?: string): void;
  /** All weights to 0, at once. */
  reset(): void;
  /** Sends weights to goals from where they stand, everywhere or in one region; `update` moves them. */
  moveTo(goals: Weights, drive?: DriveKind | Drive, region?: string): void;
  /** A blow: adds to the velocity of a weight (per second), which drag (per second, 8 unless given) takes
   * away; it comes to rest where that leaves it, and not at a goal of before. */
  push(name: string, velocityChange: number, drag?: number): void;
  /** Lets seconds pass without showing it; says whether anything goes on moving. Of less than 0, or more than 1e10 at
   * once, none pass. */
  advance(seconds: number): boolean;
  /** Call it once a frame with the seconds since the last, as `advance` takes them; costs nothing where nothing moves,
   * and does nothing once the mesh is disposed of. */
  update(seconds?: number): void;
  /** Adds an object that follows the point of the skin nearest to `point`, which is in the face's own coordinates, and
   * turns with it: what is attached to it stays where it is as long as the face does. To be taken off by `remove`. */
  pin(point: Vector3): Object3D;
  /** Makes ready to move, which else happens when it first does and takes a few frames. */
  prepare(): void;
  /** Another face of the same file with the same weights, which moves by itself. What of the geometry is the same for all
   * is shared, and so are materials, but of meshes that the graphics card evaluates, whose are clones. */
  clone(recursive?: boolean): this;
  /** Frees geometry, materials and the face. */
  dispose(): void;
}
