// The face of a scene, evaluated on the graphics card.
import {Matrix3} from 'three';
import {materialsOf, whileStanding} from './sweepface_card.js';
import {Followers, refreshShadow, sourceOf} from './sweepface_followers.js';
import {OnProcessor, toMesh} from './sweepface_scene_processor.js';
import {attributesOf, tablesOf, texturesOf} from './sweepface_textures.js';

/** Has the vertex shaders of the meshes' materials evaluate the runs of a face. */
export class OnCard {
  #way;  // how materials follow the face: what a class of meshes has as `card`
  #tables;
  #textures;
  #groups;            // of meshes that are placed alike, by run: {source, followers, meshes, clones}
  #others;            // objects that are not the face
  #made = new Set();  // materials
  #standing = {};     // for rays: the face on a `processor`, and the expression that it was evaluated `for` last

  /** `original` is what evaluates the face that this one is a clone of. */
  constructor(face, runs, way, original) {
    this.#way = way;
    this.#tables = original ? undefined : tablesOf(face);
    this.#textures = original ? original.#textures.twin() : texturesOf(this.#tables, way.integers);
    const groups = new Map();
    this.#groups = new Map([...runs].map((run) => {
      const key = String(run.world);
      if (!groups.has(key)) groups.set(key, this.#groupOf(run));
      return [run, groups.get(key)];
    }));
  }

  #groupOf({world}) {
    const {points, normals} = toMesh(world);
    const source = sourceOf(this.#textures, new Matrix3().setFromMatrix4(points), normals);
    return {source, followers: new Followers(this.#way, source), meshes: [], clones: new Map()};
  }

  /** Names of attributes that follow the weights: none, as geometries hold the neutral. */
  get changing() { return []; }

  /** Attributes that a clone has from its original already. */
  attributesOf({first, count, world}) {
    if (!this.#tables) return {};
    const attributes = attributesOf(this.#tables, Uint32Array.from({length: count}, (_, k) => first + k), true);
    const {points, normals} = toMesh(world);
    attributes.position.applyMatrix4(points);
    attributes.normal.applyNormalMatrix(normals);
    return attributes;
  }

  boundsOf() { return null; }

  /**
   * Makes the meshes of a scene's `objects` that are of the face follow it: those for which `runOf` returns a run.
   * `poseOf` returns the current expression, `face` evaluates it.
   */
  dress(objects, runOf, isClone, face, poseOf) {
    this.#tables = undefined;  // all is in textures and attributes
    this.#others = objects.filter((object) => !runOf(object));
    for (const mesh of objects.filter(runOf)) {
      const run = runOf(mesh), {meshes, source} = this.#groups.get(run);
      meshes.push(mesh);
      for (const [name, material] of Object.entries(this.#way.shadows()))
        if (isClone || !mesh[name]) mesh[name] = this.#keep(material);
      mesh.frustumCulled = false;  // bounds are those of the neutral
      for (const drawn of [mesh, mesh.geometry]) this.#way.drawn(drawn, source);
      this.#meet(mesh, run, face, poseOf);
    }
  }

  #keep(material) {
    this.#made.add(material);
    return material;
  }

  /** Has rays meet a mesh as it stands, and renderers that cannot draw it say so. */
  #meet(mesh, run, face, poseOf) {
    const {raycast, onBeforeRender, onBeforeShadow} = mesh;
    mesh.raycast = (raycaster, hits) => {
      const pose = poseOf();
      if (pose) whileStanding(mesh.geometry, this.#stand(face, run, pose), () => raycast.call(mesh, raycaster, hits));
    };
    mesh.onBeforeRender = (renderer, ...others) => {
      this.#way.meet(renderer);
      onBeforeRender.call(mesh, renderer, ...others);
    };
    mesh.onBeforeShadow = (...given) => {
      refreshShadow(mesh, given[5]);
      onBeforeShadow?.apply(mesh, given);
    };
  }

  #stand(face, run, pose) {
    const standing = this.#standing, processor = standing.processor ??= new OnProcessor(face, this.#groups.keys());
    if (standing.for !== pose) processor.show(face);
    standing.for = pose;
    return {...processor.attributesOf(run), sphere: processor.boundsOf(run)};
  }

  /**
   * Makes the meshes' current materials follow the face. Those that others have as well, or meshes that are placed
   * otherwise, are replaced by clones.
   */
  follow() {
    const groups = new Set(this.#groups.values());
    for (const {followers, meshes} of groups) followers.keep(meshes.flatMap(materialsOf));
    for (const group of groups) {
      for (const mesh of group.meshes) this.#separate(mesh, group);
      group.followers.follow(group.meshes.flatMap(materialsOf));
    }
  }

  #separate(mesh, {followers, clones}) {
    const own = (material) => {
      if (followers.has(material) || !(followers.isTaken(material) || this.#isElsewhere(material))) return material;
      if (!clones.has(material)) clones.set(material, this.#keep(followers.cloneOf(material, true)));
      return clones.get(material);
    };
    const {material} = mesh, isMany = Array.isArray(material), all = [material].flat(), owned = all.map(own);
    if (owned.some((each, k) => each !== all[k])) mesh.material = isMany ? owned : owned[0];
    for (const name of ['customDepthMaterial', 'customDistanceMaterial']) if (mesh[name]) mesh[name] = own(mesh[name]);
  }

  #isElsewhere(material) { return this.#others.some((other) => [other.material].flat().includes(material)); }

  show(face) { this.#textures.update(face); }

  dispose() {
    this.#textures.dispose();
    for (const {followers} of this.#groups.values()) followers.dispose();
    for (const material of this.#made) material.dispose();
  }
}
