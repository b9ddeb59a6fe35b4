// The face of a scene: the meshes that follow its weights.
import {BufferAttribute, DynamicDrawUsage, Matrix3, Matrix4, Sphere} from 'three';
import * as SkeletonUtils from 'three/addons/utils/SkeletonUtils.js';
import {FaceGeometry, faceGeometryOf} from './sweepface_geometry.js';
import {begin, isGone, movedByWeights, release, show, takeInfluences} from './sweepface_moved.js';
import {bound} from './sweepface_three.js';
import {twinOf} from './sweepface_twin.js';

/** Attributes that follow the face. */
const CHANGING = ['position', 'normal'];

/** Vertices that meshes share: attributes for their part of a face's positions and normals. */
class Run {
  #toMesh;  // from the space of the scene to that of the mesh, unless they are the same
  bounds = new Sphere();

  constructor({first, count, world}, {positions, normals}) {
    const own = (all) => new BufferAttribute(all.subarray(3 * first, 3 * (first + count)), 3).setUsage(DynamicDrawUsage);
    this.position = own(positions);
    this.normal = own(normals);
    if (world.equals(new Matrix4())) return;
    const points = world.clone().invert();
    this.#toMesh = {points, normals: new Matrix3().getNormalMatrix(points)};
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

/** All objects of some scenes. */
function objectsIn(scenes) {
  const found = [];
  for (const scene of scenes) scene.traverse((object) => found.push(object));
  return found;
}

/** Geometries, materials and their textures, all of which renderers hold on to. */
function resourcesOf(objects, isOwn) {
  const found = new Set();
  for (const each of objects.flatMap(({geometry, material}) => [geometry, material].flat()).filter(Boolean)) {
    if (isOwn(each)) continue;
    found.add(each);
    const uniforms = Object.values(each.uniforms ?? {}).map((uniform) => uniform?.value);
    for (const value of [...Object.values(each), ...uniforms]) if (value?.isTexture) found.add(value);
  }
  return found;
}

/** Gives meshes of the face geometries that `make` makes of theirs; returns what each of these is of the face. */
function refit(objects, parts, make) {
  const made = new Map();
  for (const object of objects.filter(({geometry}) => parts.has(geometry))) {
    const {geometry} = object;
    if (!made.has(geometry)) made.set(geometry, make(geometry));
    object.geometry = made.get(geometry);
  }
  return new Map([...made].map(([geometry, own]) => [own, parts.get(geometry)]));
}

const freshGeometry = (geometry) => faceGeometryOf(geometry, CHANGING);

function clonedGeometry(geometry) {
  const clone = new FaceGeometry().fix(CHANGING);
  clone.take(geometry);
  return clone;
}

/** The face of a scene. Whatever moves morph targets moves it, too. */
export class SceneFace extends movedByWeights(Object) {
  #arrays;
  #runs;
  #parts;   // what each geometry is of the face
  #meshes;
  #own;     // what else goes with the face
  #shared;  // by a model and its clones: {users, resources}

  /** `parts` is a map from geometries in the scenes, which make room for others: {run, names}. */
  constructor(face, scenes, parts, make = freshGeometry, shared) {
    super();
    const numbers = () => new Float32Array(3 * face.vertexCount), objects = objectsIn(scenes);
    this.#arrays = {positions: numbers(), normals: numbers()};
    this.#parts = refit(objects, parts, make);
    const runs = new Set([...this.#parts.values()].map(({run}) => run));
    this.#runs = new Map([...runs].map((run) => [run, new Run(run, this.#arrays)]));
    this.#meshes = objects.filter(({geometry}) => this.#parts.has(geometry));
    this.#own = objects.flatMap((object) => [object.skeleton, object.isInstancedMesh && object]).filter(Boolean);
    this.#shared = shared ?? {users: 0, resources: resourcesOf(objects, (each) => this.#parts.has(each))};
    ++this.#shared.users;
    for (const [geometry, {run}] of this.#parts) {
      const {position, normal, bounds} = this.#runs.get(run);
      geometry.setAttribute('position', position);
      if (geometry.attributes.normal) geometry.setAttribute('normal', normal);
      geometry.boundingSphere = bounds;
    }
    const index = new Map(face.names.map((name, k) => [name, k]));
    this[begin](face, this.#meshes.map((mesh) => {
      return {mesh, targets: this.#parts.get(mesh.geometry).names.map((name) => index.get(name) ?? -1)};
    }), !shared);
    this.update();
  }

  /** The meshes that show the face; nodes may share a geometry. */
  get meshes() { return [...this.#meshes]; }

  update(seconds) {
    const other = this[isGone] ? undefined : this.#meshes.find(({geometry, morphTargetInfluences: influences}) => {
      const part = this.#parts.get(geometry);
      return !part || (influences && influences.length !== part.names.length);
    });
    if (other)
      throw new Error(`The mesh '${other.name}' must keep the geometry and influences that it was loaded with, ` +
                      'which follow the face.');
    return super.update(seconds);
  }

  [show]() {
    this.face.evaluate(this.#arrays.positions, this.#arrays.normals);
    for (const run of this.#runs.values()) run.update();
    for (const geometry of this.#parts.keys()) if (geometry.boundingBox) geometry.computeBoundingBox();
  }

  /** A copy of a scene with a face of its own, in the same pose: {scene, face}. */
  cloneIn(scene) {
    this[takeInfluences]();
    const copy = SkeletonUtils.clone(scene), face = twinOf(this.face);
    try {
      return {scene: copy, face: new SceneFace(face, [copy], this.#parts, clonedGeometry, this.#shared)};
    } catch (error) {
      face.dispose();
      throw error;
    }
  }

  /** Frees the geometries of the face, and what else the scene was loaded with if no clone shows it. */
  [release]() {
    const isLast = --this.#shared.users === 0;
    for (const each of [...this.#parts.keys(), ...this.#own, ...(isLast ? this.#shared.resources : [])]) each.dispose();
  }
}
