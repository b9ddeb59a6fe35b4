// The face of a scene, evaluated on the processor.
import {BufferAttribute, DynamicDrawUsage, Matrix3, Matrix4, Sphere} from 'three';
import {IDENTITY, inverse} from './sweepface_affine.js';
import {bound} from './sweepface_three.js';

/** What brings points and normals from the space of the scene to that of a mesh that `world` places in it. */
export function toMesh(world) {
  const points = new Matrix4().fromArray(inverse(world));
  return {points, normals: new Matrix3().getNormalMatrix(points)};
}

/** Vertices that meshes share: attributes for their part of a face's positions and normals. */
class Run {
  #toMesh;  // unless it is in its place
  bounds = new Sphere();

  constructor({first, count, world}, {positions, normals}) {
    const own = (all) => new BufferAttribute(all.subarray(3 * first, 3 * (first + count)), 3).setUsage(DynamicDrawUsage);
    this.position = own(positions);
    this.normal = own(normals);
    if (world.some((value, k) => value !== IDENTITY[k])) this.#toMesh = toMesh(world);
  }

  /** Brings the attributes to the space of the mesh after the face has been evaluated. */
  update() {
    if (this.#toMesh) {
      this.position.applyMatrix4(this.#toMesh.points);
      this.normal.applyNormalMatrix(this.#toMesh.normals);
    }
    this.position.needsUpdate = this.normal.needsUpdate = true;
    bound(this.position, this.bounds);
  }
}

/** Evaluates the runs of a face into attributes of the meshes' geometries. */
export class OnProcessor {
  #arrays;
  #runs;

  constructor(face, runs) {
    const numbers = () => new Float32Array(3 * face.vertexCount);
    this.#arrays = {positions: numbers(), normals: numbers()};
    this.#runs = new Map([...runs].map((run) => [run, new Run(run, this.#arrays)]));
  }

  /** Names of attributes that follow the weights. */
  get changing() { return ['position', 'normal']; }

  attributesOf(run) {
    const {position, normal} = this.#runs.get(run);
    return {position, normal};
  }

  boundsOf(run) { return this.#runs.get(run).bounds; }

  show(face) {
    face.evaluate(this.#arrays.positions, this.#arrays.normals);
    for (const run of this.#runs.values()) run.update();
  }

  dress() {}
  follow() {}
  dispose() {}
}
