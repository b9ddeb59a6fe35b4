// The face of a scene, evaluated on the graphics card.
import {Matrix3} from 'three';
import {materialsOf, whileStanding} from './sweepface_card.js';
import {Followers, sourceOf} from './sweepface_followers.js';
import {OnProcessor, toMesh} from './sweepface_scene_processor.js';
import {attributesOf, tablesOf, Textures} from './sweepface_textures.js';

/** Has the vertex shaders of the meshes' materials evaluate the runs of a face. */
export class OnCard {
  #way;  // how materials follow the face: what a class of meshes has as `card`
  #tables;
  #textures;
  #groups;            // of meshes that are placed alike, by run: {source, followers, meshes, clones}
  #made = new Set();  // materials
  #standing = {};     // for rays: the face on a `processor`, and the expression that it was evaluated `for` last

  /** `original` is what evaluates the face that this one is a clone of. */
  constructor(face, runs, way, original) {
    this.#way = way;
    this.#tables = tablesOf(face);
    this.#textures = new Textures(this.#tables, way.integers);
    if (original) this.#textures.share(original.#textures);
    const groups = new Map();
    this.#groups = new Map([...runs].map((run) => {
      const key = String(run.world.elements);
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

  attributesOf({first, count, world}) {
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
    const owners = new Map();  // by material: the group that it follows with, or null if it cannot
    for (const mesh of objects.filter((object) => object.material && (isClone || !runOf(object))))
      for (const material of [mesh.material].flat()) owners.set(material, null);
    for (const mesh of objects.filter(runOf)) this.#dressMesh(mesh, runOf(mesh), owners, isClone);
    for (const mesh of objects.filter(runOf)) this.#meet(mesh, runOf(mesh), face, poseOf);
    this.#tables = undefined;  // all is in textures and attributes
  }

  #dressMesh(mesh, run, owners, isClone) {
    const group = this.#groups.get(run);
    group.meshes.push(mesh);
    const own = (material) => {
      if (!owners.has(material)) owners.set(material, group);
      if (owners.get(material) === group) return material;
      if (!group.clones.has(material)) group.clones.set(material, this.#keep(group.followers.cloneOf(material)));
      return group.clones.get(material);
    };
    mesh.material = Array.isArray(mesh.material) ? mesh.material.map(own) : own(mesh.material);
    for (const [name, material] of Object.entries(this.#way.shadows()))
      if (isClone || !mesh[name]) mesh[name] = this.#keep(material);
    mesh.frustumCulled = false;  // bounds are those of the neutral
    for (const drawn of [mesh, mesh.geometry]) this.#way.drawn(drawn, group.source);
  }

  #keep(material) {
    this.#made.add(material);
    return material;
  }

  /** Has rays meet a mesh as it stands, and renderers that cannot draw it say so. */
  #meet(mesh, run, face, poseOf) {
    const {raycast, onBeforeRender} = mesh;
    mesh.raycast = (raycaster, hits) => {
      const pose = poseOf();
      if (pose) whileStanding(mesh.geometry, this.#stand(face, run, pose), () => raycast.call(mesh, raycaster, hits));
    };
    mesh.onBeforeRender = (renderer, ...others) => {
      this.#way.meet(renderer);
      onBeforeRender.call(mesh, renderer, ...others);
    };
  }

  #stand(face, run, pose) {
    const standing = this.#standing, processor = standing.processor ??= new OnProcessor(face, this.#groups.keys());
    if (standing.for !== pose) processor.show(face);
    standing.for = pose;
    return {...processor.attributesOf(run), sphere: processor.boundsOf(run)};
  }

  follow() {
    for (const {followers, meshes} of new Set(this.#groups.values())) followers.follow(meshes.flatMap(materialsOf));
  }

  show(face) { this.#textures.update(face); }

  dispose() {
    this.#textures.dispose();
    for (const {followers} of this.#groups.values()) followers.dispose();
    for (const material of this.#made) material.dispose();
  }
}
