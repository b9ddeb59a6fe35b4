// The face of a scene: the meshes that follow its weights.
import {BufferAttribute, DynamicDrawUsage, Matrix3, Matrix4, Sphere} from 'three';
import * as SkeletonUtils from 'three/addons/utils/SkeletonUtils.js';
import {begin, movedByWeights, show, takeInfluences} from './sweepface_moved.js';
import {bound} from './sweepface_three.js';
import {twinOf} from './sweepface_twin.js';

/** Vertices that meshes share: attributes that follow the face, whose positions and normals are in the space of the scene. */
class Run {
  #inScene;
  #toMesh;  // from the space of the scene to that of the mesh; null if they are the same

  constructor({first, count, world}, {positions, normals}) {
    const own = ([name, array]) => [name, array.subarray(3 * first, 3 * (first + count))];
    this.#inScene = Object.fromEntries(Object.entries({position: positions, normal: normals}).map(own));
    if (!world.equals(new Matrix4())) {
      const points = world.clone().invert();
      this.#toMesh = {points, normals: new Matrix3().getNormalMatrix(points)};
    }
    const attribute = (array) => new BufferAttribute(this.#toMesh ? array.slice() : array, 3).setUsage(DynamicDrawUsage);
    this.position = attribute(this.#inScene.position);
    this.normal = attribute(this.#inScene.normal);
  }

  /** Brings the attributes up to date. */
  update() {
    const {position, normal} = this;
    if (this.#toMesh) {
      position.copyArray(this.#inScene.position).applyMatrix4(this.#toMesh.points);
      normal.copyArray(this.#inScene.normal).applyNormalMatrix(this.#toMesh.normals);
    }
    position.needsUpdate = normal.needsUpdate = true;
  }
}

/** All objects of some scenes. */
function objectsIn(scenes) {
  const found = [];
  for (const scene of scenes) scene.traverse((object) => found.push(object));
  return found;
}

/** The face of a scene. Whatever moves morph targets moves it, too. */
export class SceneFace extends movedByWeights(Object) {
  #arrays;
  #runs;
  #parts;  // what each geometry is of the face
  #meshes;
  #scenes;
  #group;  // of all faces that show the same materials

  /** `parts` is a map from the geometries in the scenes that show the face: {run, names}. */
  constructor(face, scenes, parts, group = new Set()) {
    super();
    const numbers = () => new Float32Array(3 * face.vertexCount), runs = new Set([...parts.values()].map(({run}) => run));
    this.#arrays = {positions: numbers(), normals: numbers()};
    this.#runs = new Map([...runs].map((run) => [run, new Run(run, this.#arrays)]));
    this.#scenes = scenes;
    this.#parts = parts;
    this.#group = group.add(this);
    for (const [geometry, {run}] of parts) {
      const {position, normal} = this.#runs.get(run);
      geometry.setAttribute('position', position);
      if (geometry.attributes.normal) geometry.setAttribute('normal', normal);
      geometry.boundingBox = null;
      geometry.boundingSphere = new Sphere();
    }
    this.#meshes = objectsIn(scenes).filter(({geometry}) => parts.has(geometry));
    const index = new Map(face.names.map((name, k) => [name, k]));
    this[begin](face, this.#meshes.map((mesh) => {
      return {mesh, targets: parts.get(mesh.geometry).names.map((name) => index.get(name) ?? -1)};
    }));
    this.update();
  }

  /** The meshes that show the face; nodes may share a geometry. */
  get meshes() { return [...this.#meshes]; }

  [show]() {
    const other = this.#meshes.find(({geometry}) => !this.#parts.has(geometry));
    if (other)
      throw new Error(`The mesh '${other.name}' must keep the geometry that it was loaded with, whose vertices follow the face.`);
    this.face.evaluate(this.#arrays.positions, this.#arrays.normals);
    for (const run of this.#runs.values()) run.update();
    for (const geometry of this.#parts.keys()) {
      bound(geometry.attributes.position, geometry.boundingSphere);
      if (geometry.boundingBox) geometry.computeBoundingBox();
    }
  }

  /** A copy of a scene with a face of its own, in the same pose: {scene, face}. */
  cloneIn(scene) {
    this[takeInfluences]();
    const copy = SkeletonUtils.clone(scene), parts = new Map(), own = new Map();
    for (const object of objectsIn([copy]).filter(({geometry}) => this.#parts.has(geometry))) {
      const {geometry} = object;
      if (!own.has(geometry)) own.set(geometry, geometry.clone());
      object.geometry = own.get(geometry);
      parts.set(object.geometry, this.#parts.get(geometry));
    }
    return {scene: copy, face: new SceneFace(twinOf(this.face), [copy], parts, this.#group)};
  }

  /** Frees the face and its geometries, and what else the scene holds with the last of its clones. */
  dispose() {
    super.dispose();
    this.#group.delete(this);
    const isLast = this.#group.size === 0, all = new Set(this.#parts.keys());
    for (const {geometry, material, skeleton} of objectsIn(this.#scenes)) {
      if (skeleton) all.add(skeleton);
      for (const shared of isLast ? [geometry, material].flat().filter(Boolean) : []) all.add(shared);
    }
    for (const each of all) {
      for (const texture of Object.values(each).filter((value) => value?.isTexture)) texture.dispose();
      each.dispose();
    }
  }
}
