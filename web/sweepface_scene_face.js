// The face of a scene: the meshes that follow its weights.
import * as SkeletonUtils from 'three/addons/utils/SkeletonUtils.js';
import {faceGeometryOf, twinGeometry} from './sweepface_geometry.js';
import {
  begin, expression, follow, isGone, movedByWeights, release, show, takeInfluences
} from './sweepface_moved.js';
import {OnCard} from './sweepface_scene_card.js';
import {OnProcessor} from './sweepface_scene_processor.js';
import {twinOf} from './sweepface_twin.js';

/** All objects of some scenes. */
function objectsIn(scenes) {
  const found = [];
  for (const scene of scenes) scene.traverse((object) => found.push(object));
  return found;
}

/** The names of an object's influences, or undefined if it has none. */
function namesOf({morphTargetDictionary: dictionary, morphTargetInfluences: influences}) {
  if (!dictionary || !influences) return undefined;
  const names = influences.map(() => undefined);
  for (const [name, k] of Object.entries(dictionary)) if (k in names) names[k] = name;
  return names;
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

/** The face of a scene. Whatever moves morph targets moves it, too. */
export class SceneFace extends movedByWeights(Object) {
  #way;         // how materials follow the face, if the graphics card evaluates it
  #evaluation;  // brings the weights to the screen
  #parts;       // what each geometry is of the face
  #meshes;
  #own;         // what else goes with the face
  #shared;      // by a model and its clones: {users, resources}

  /**
   * `parts` is a map from geometries in the scenes, which make room for others: {run, names}. `way` is how materials are
   * to follow the face (sweepface_followers.js); without, it is evaluated on the processor. `original` is the face that
   * this one is a clone of.
   */
  constructor(face, scenes, parts, way, original) {
    super();
    const objects = objectsIn(scenes), runs = new Set([...parts.values()].map(({run}) => run));
    this.#way = way;
    this.#evaluation = way ? new OnCard(face, runs, way, original?.#evaluation) : new OnProcessor(face, runs);
    this.#parts = refit(objects, parts, (geometry) => this.#geometryFor(geometry, parts.get(geometry), original));
    const runOf = ({geometry}) => this.#parts.get(geometry)?.run;
    this.#meshes = objects.filter(runOf);
    this.#own = objects.flatMap((object) => [object.skeleton, object.isInstancedMesh && object]).filter(Boolean);
    this.#shared = original?.#shared ?? {users: 0, resources: resourcesOf(objects, (each) => this.#parts.has(each))};
    ++this.#shared.users;
    try {
      this.#evaluation.dress(objects, runOf, Boolean(original), face, () => (this[isGone] ? undefined : this[expression]));
      this.#begin(face, objects, !original);
    } catch (error) {
      this[release]();
      throw error;
    }
  }

  #begin(face, objects, isPosed) {
    const meshes = this.#meshes.map((mesh) => ({mesh, names: this.#parts.get(mesh.geometry).names}));
    const others = objects.filter((object) => namesOf(object) && !this.#meshes.includes(object))
        .map((mesh) => ({mesh, names: namesOf(mesh), onlyFollows: true}));
    this[begin](face, [...meshes, ...others], isPosed);
    this.update();
  }

  #geometryFor(geometry, {run}, original) {
    const {changing} = this.#evaluation, make = original ? twinGeometry : faceGeometryOf;
    const made = make(geometry, this.#evaluation.attributesOf(run), changing);
    made.boundingSphere = this.#evaluation.boundsOf(run);
    return made;
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

  [follow]() { this.#evaluation.follow(); }

  [show]() {
    this.#evaluation.show(this.face);
    if (this.#evaluation.changing.length === 0) return;
    for (const geometry of this.#parts.keys()) if (geometry.boundingBox) geometry.computeBoundingBox();
  }

  /** A copy of a scene with a face of its own, in the same pose: {scene, face}. */
  cloneIn(scene) {
    this[takeInfluences]();
    const copy = SkeletonUtils.clone(scene), face = twinOf(this.face);
    try {
      return {scene: copy, face: new SceneFace(face, [copy], this.#parts, this.#way, this)};
    } catch (error) {
      face.dispose();
      throw error;
    }
  }

  /** Frees the geometries of the face, and what else the scene was loaded with if no clone shows it. */
  [release]() {
    const isLast = --this.#shared.users === 0;
    this.#evaluation.dispose();
    for (const each of [...this.#parts.keys(), ...this.#own, ...(isLast ? this.#shared.resources : [])]) each.dispose();
  }
}
