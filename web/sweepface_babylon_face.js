// The face of a scene of Babylon.js: the meshes that follow its weights.
import {VertexBuffer} from '@babylonjs/core/Buffers/buffer.js';
import {IDENTITY, inverse, transform, transformNormalsBack} from './sweepface_affine.js';
import {bound, endsOf} from './sweepface_babylon_bounds.js';
import {eachFrame} from './sweepface_babylon_frames.js';
import {begin, isGone, movedByWeights, release, show, shown} from './sweepface_moved.js';
import {leftOf} from './sweepface_scene_left.js';

const {PositionKind, NormalKind, UVKind} = VertexBuffer;

/** The targets of a mesh, which hold influences. */
function targetsOf({morphTargetManager: manager}) {
  return Array.from({length: manager?.numTargets ?? 0}, (_, k) => manager.getTarget(k));
}

/** The influences of targets, like an array of numbers. */
function influencesOf(targets) {
  const influences = {length: targets.length};
  targets.forEach((target, k) => Object.defineProperty(influences, k, {
    get: () => target.influence, set: (value) => target.influence = value, enumerable: true
  }));
  return influences;
}

/** Has targets that hold nothing stay out of shaders, whatever their influences. */
function keepOut({morphTargetManager: manager}, targets) {
  if (!manager) return;
  const influences = targets.map(({influence}) => influence);
  for (const target of targets) target.influence = 0;
  manager.numMaxInfluencers = 0;
  manager.optimizeInfluencers = true;  // those that are 0 do not count
  for (const isFrozen of [true, false, true]) manager.areUpdatesFrozen = isFrozen;  // counts them, for the last time
  targets.forEach((target, k) => target.influence = influences[k]);
}

/** Drops tracks that keep targets at 0, so that these can be moved meanwhile. */
function dropStill(groups, targets) {
  const isZero = ({value, inTangent, outTangent}) => value === 0 && !inTangent && !outTangent;
  const isStill = ({animation, target}) => targets.has(target) && animation.getKeys().every(isZero);
  for (const group of groups) {
    const still = group.targetedAnimations.filter(isStill), {isStarted, loopAnimation, speedRatio} = group;
    if (still.length === 0) continue;
    if (isStarted) group.stop();  // or what has started goes on
    for (const {animation} of still) group.removeTargetedAnimation(animation);
    if (isStarted) group.start(loopAnimation, speedRatio);
  }
}

/** The meshes that Babylon.js made of each part, as a map from parts; several where several nodes show it. */
function meshesOf({meshes}, parts) {
  const made = new Map();  // by pointers into the JSON
  for (const mesh of meshes)
    for (const pointer of mesh._internalMetadata?.gltf?.pointers ?? [])
      made.set(pointer, [...made.get(pointer) ?? [], mesh]);
  return new Map(parts.map((part) => [part, made.get(`/meshes/${part.mesh}/primitives/${part.primitive}`) ?? []]));
}

/** What is wrong with a face whose meshes Babylon.js does not load, as the scene that it shows lacks them. */
const unshown = (name, how) => new Error(`${name}: the scene of its file shows ${how} of the meshes of the face; ` +
                                         'load the face alone by SweepfaceMesh.load.');

/** Vertices that meshes share: their part of a face's positions and normals. */
class Run {
  #world;  // unless it is in its place
  #inverse;

  constructor({first, count, world}, {positions, normals}) {
    this.positions = positions.subarray(3 * first, 3 * (first + count));
    this.normals = normals.subarray(3 * first, 3 * (first + count));
    if (world.every((value, k) => value === IDENTITY[k])) return;
    this.#world = world;
    this.#inverse = inverse(world);
  }

  /** Brings them to the space of the mesh after the face has been evaluated. */
  update() {
    if (this.#world) {
      transform(this.#inverse, this.positions);
      transformNormalsBack(this.#world, this.normals);
    }
    this.ends = endsOf(this.positions);
  }
}

/** The face of a scene. Weights can be set at any time; each time the scene is rendered, it moves on and follows them. */
export class SceneFace extends movedByWeights(Object) {
  /** Whether time passes with the frames of the scene; false where something else, such as a TimelinePlayer, advances it. */
  advancesWithScene = true;

  #container;
  #arrays;
  #runs = new Map();
  #meshes = new Map();  // the run of each
  #leave;

  constructor(face, container, scene, name) {
    super();
    const numbers = () => new Float32Array(3 * face.vertexCount);
    this.#container = container;
    this.#arrays = {positions: numbers(), normals: numbers()};
    const made = meshesOf(container, scene.parts);
    this.#fill(scene, made, face, name);
    this.#begin(face, made);
    const pass = (seconds) => seconds > 0 && this.advancesWithScene && !this[isGone] && this.advance(seconds);
    this.#leave = eachFrame(container.scene, pass, () => this.update());
    for (const mesh of this.#meshes.keys())
      mesh.onDisposeObservable.add(() => this.meshes.every((each) => each.isDisposed()) && this.dispose());
  }

  /** Gives meshes what the scene leaves to the face, and room for what follows the weights. */
  #fill({json, parts}, made, face, name) {
    const shapeOf = (part) => {
      const [mesh] = made.get(part);
      if (!mesh) throw unshown(name, 'not all');
      const indices = mesh.isUnIndexed ? undefined : mesh.getIndices();
      return {indices, vertexCount: mesh.getTotalVertices(), mode: json.meshes[part.mesh].primitives[part.primitive].mode};
    };
    if (parts.every((part) => made.get(part).length === 0)) throw unshown(name, 'none');
    for (const [part, {indices, texcoords}] of leftOf(json, parts, shapeOf, face, name)) {
      const {run} = part;
      if (!this.#runs.has(run)) this.#runs.set(run, new Run(run, this.#arrays));
      const {positions, normals} = this.#runs.get(run);
      for (const mesh of made.get(part)) {
        const hasNormals = mesh.isVerticesDataPresent(NormalKind);
        if (mesh.geometry) mesh.geometry.useBoundingInfoFromGeometry = false;
        mesh.setVerticesData(PositionKind, positions, true);
        if (hasNormals) mesh.setVerticesData(NormalKind, normals, true);
        if (texcoords) mesh.setVerticesData(UVKind, texcoords);
        if (indices) mesh.isUnIndexed = false;
        if (indices) mesh.setIndices(indices);
        this.#meshes.set(mesh, this.#runs.get(run));
      }
    }
  }

  #begin(face, made) {
    const own = [...made].flatMap(([{names}, meshes]) => meshes.map((mesh) => ({names, mesh, targets: targetsOf(mesh)})));
    const others = this.#container.meshes.filter((mesh) => !this.#meshes.has(mesh)).map(targetsOf);
    for (const {mesh, targets} of own) keepOut(mesh, targets);
    const isFollowing = ({name}) => face.names.includes(name);
    dropStill(this.#container.animationGroups,
              new Set([...own.flatMap(({targets}) => targets), ...others.flat().filter(isFollowing)]));
    const follower = (targets, names, onlyFollows) => {
      return {mesh: {morphTargetInfluences: influencesOf(targets)}, names, onlyFollows};
    };
    this[begin](face, [
      ...own.map(({names, targets}) => follower(targets, names, false)),
      ...others.map((targets) => follower(targets, targets.map(({name}) => name), true))
    ], true);
    this.update();
  }

  /** The meshes that show the face. */
  get meshes() { return [...this.#meshes.keys()]; }

  [show]() {
    const {positions, normals} = this.#arrays;
    this.face.evaluate(positions, normals);
    for (const run of this.#runs.values()) run.update();
    for (const [mesh, run] of this.#meshes) {
      mesh.updateVerticesData(PositionKind, run.positions);
      if (mesh.isVerticesDataPresent(NormalKind)) mesh.updateVerticesData(NormalKind, run.normals);
      if (!mesh.skeleton) bound(mesh, run.ends);
      else if (!this[shown]) mesh.refreshBoundingInfo(true);  // which takes long, so once, as Babylon.js does
    }
  }

  /** Frees the face and all that it was loaded with. */
  [release]() {
    this.#leave?.();
    this.#container.dispose();
  }
}
