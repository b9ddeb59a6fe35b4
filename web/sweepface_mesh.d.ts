import type {BufferGeometry, Material, Mesh, MeshStandardMaterial, Object3D, Vector3} from 'three';
import type {Drive, DriveKind, Pose, ReadonlyPose, Sweepface, Weights} from './sweepface.js';

/** A face in a scene. Weights are set at any time; `update` brings them to the screen. */
export class FaceMesh<Materials extends Material | Material[] = MeshStandardMaterial[]>
    extends Mesh<BufferGeometry, Materials> {
  /** Materials: one for all, or one for each part of the face; unless given, plain ones named as in the source. If
   * several meshes show one face, only one of them may let its time pass. */
  protected constructor(face: Sweepface, geometry: BufferGeometry, materials?: Materials);
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  readonly names: string[];
  readonly eyeCount: number;
  readonly regions: string[];
  /** The current weights, and in `pose` the eyes. */
  readonly weights: Readonly<Weights>;
  /** The weights by the index of their names, as other meshes have them; of several regions, those of the first. A
   * number that you change here counts from the next `update` on, in all regions; what is not a number changes
   * nothing. */
  morphTargetInfluences: number[];
  morphTargetDictionary: Record<string, number>;
  weightsIn(region: string): Readonly<Weights>;
  readonly pose: ReadonlyPose | null;
  /** Turns the eyes; null: by the weights of eyeLook targets. */
  look(pose: Pose | null): void;

  /** Sets the named weights at once, everywhere or in one region; the others stay. */
  setWeights(weights: Weights, region?: string): void;
  /** Sets all weights to 0 at once. */
  reset(): void;
  /** Sends weights from where they are to goals, everywhere or in one region; `update` moves them. */
  moveTo(goals: Weights, drive?: DriveKind | Drive, region?: string): void;
  /** An impulse: adds to the velocity of a weight (per second), which drag (per second, 8 unless given) then takes away.
   * The weight comes to rest wherever that leaves it, not at an earlier goal. */
  push(name: string, velocityChange: number, drag?: number): void;
  /** Lets time pass without showing it; returns whether anything still moves or waits to. No time passes if `seconds`
   * is less than 0 or more than 1e10. */
  advance(seconds: number): boolean;
  /** Call it once a frame with the seconds since the last, as for `advance`. It costs nothing while nothing moves, and
   * does nothing once the mesh is disposed of. Returns whether there is something new to draw, or will be in the next
   * frame: applications that draw on demand go on as long as it does. */
  update(seconds?: number): boolean;
  /** Adds an object that follows the point of the skin nearest to `point` (in the face's own coordinates) and turns with
   * it. At first its axes are the face's. Take it off with `remove`. */
  pin(point: Vector3): Object3D;
  /** Gets the face ready to move. Otherwise that happens when it first moves, and takes a few frames. */
  prepare(): void;
  /** Another face of the same file with the same weights, which moves by itself. The parts of the geometry that are the
   * same for all are shared. Materials are shared, too, except those of meshes that the graphics card evaluates, which
   * are cloned. */
  clone(recursive?: boolean): this;
  /** Frees the geometry and the face, and the materials unless clones show them. */
  dispose(): void;
}
