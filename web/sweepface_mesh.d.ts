import type {BufferGeometry, Material, Mesh, MeshStandardMaterial, Object3D, Vector3} from 'three';
import type {Moved, Sweepface} from './sweepface.js';

export interface FaceMesh<Materials extends Material | Material[] = MeshStandardMaterial[]> extends Moved {}

/** A face in a scene. Weights are set at any time; `update` brings them to the screen. */
export class FaceMesh<Materials extends Material | Material[] = MeshStandardMaterial[]>
    extends Mesh<BufferGeometry, Materials> {
  /** Materials: one for all, or one for each part of the face; unless given, plain ones named as in the source. Every
   * mesh needs a face of its own, which clone() makes at little cost: it frees the face with itself. */
  protected constructor(face: Sweepface, geometry: BufferGeometry, materials?: Materials);
  /** For reading: what is set there does not show. */
  readonly face: Sweepface;
  /** The weights by the index of their names, as other meshes have them; of several regions, those of the first. A
   * number that you change here counts from the next `update` on, in all regions; what is no weight (no number,
   * or beyond ±1,000,000) changes nothing. */
  morphTargetInfluences: number[];
  morphTargetDictionary: Record<string, number>;
  /** Call it once a frame with the seconds since the last, as for `advance`. It costs nothing while nothing moves, and
   * does nothing once the mesh is disposed of. Returns whether there is something new to draw, or will be in the next
   * frame: applications that draw on demand go on as long as it does. */
  update(seconds?: number): boolean;
  /** Adds an object that follows the point of the skin nearest to `point` (in the face's own coordinates) and turns with
   * it. At first its axes are the face's. Take it off with `remove`. */
  pin(point: Vector3): Object3D;
  /** Another face of the same file with the same weights, which moves by itself. The parts of the geometry that are the
   * same for all are shared. Materials are shared, too, except those of meshes that the graphics card evaluates, which
   * are cloned. */
  clone(recursive?: boolean): this;
  /** Frees the geometry and the face, and the materials unless clones show them. */
  dispose(): void;
}
