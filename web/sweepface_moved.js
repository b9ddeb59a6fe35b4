// What moves a face in a three.js scene: its weights, and the influences of morph targets that others set.
import {isWeight} from './sweepface_values.js';

/**
 * What a class defines for itself: `show` brings weights to the screen, `follow` handles other changes, `release` frees
 * what it holds besides the face. And what it may use: `begin` takes the face and the meshes whose influences move it,
 * `takeInfluences` sets weights from these. `expression` is an object that identifies the current expression, `shown` the
 * one that is on show. `isGone` is true once it is disposed of.
 */
export const show = Symbol('show'), follow = Symbol('follow'), begin = Symbol('begin');
export const takeInfluences = Symbol('takeInfluences'), expression = Symbol('expression'), shown = Symbol('shown');
export const isGone = Symbol('isGone'), release = Symbol('release');

/**
 * A class of what shows a face. Weights can be set at any time; `update` brings them to the screen. They are also
 * written to `morphTargetInfluences` and read back from there, so that whatever moves morph targets moves a face.
 */
export const movedByWeights = (Base) => class extends Base {
  #moving = false;
  #isGone = false;
  #followers = [];  // meshes, for each influence the number of its target or -1, and the influences as they were last written
  #companions = [];  // likewise, of what is not the face, and the weights that they were last written for
  #expression = {};  // a new object whenever weights or eyes are set
  #shown;

  /**
   * `meshes` have influences, the k-th of the target `names[k]`, if the face has one of that name. They move the face,
   * unless they only follow it, until something else moves them. If `isPosed`, the face takes its weights from these.
   */
  [begin](face, meshes, isPosed = false) {
    this.face = face;
    const numbers = new Map(face.names.map((name, k) => [name, k]));
    const numbersOf = (names) => names.map((name) => numbers.get(name) ?? -1);
    this.#followers = meshes.filter(({onlyFollows}) => !onlyFollows)
        .map(({mesh, names}) => ({mesh, targets: numbersOf(names), told: names.map(() => 0)}));
    this.#moving = face.advance(0);
    if (isPosed) this[takeInfluences]();
    const weights = [...face.weightValues];
    this.#companions = meshes.filter(({onlyFollows}) => onlyFollows).map(({mesh, names}) => {
      const targets = numbersOf(names), told = names.map((_, k) => mesh.morphTargetInfluences[k]);
      return {mesh, targets, told, weights: targets.map((target) => weights[target])};
    });
    this.#tellInfluences();
  }

  get names() { return this.face.names; }
  get weights() { return this.face.weights; }
  get pose() { return this.face.pose; }
  get eyeCount() { return this.face.eyeCount; }
  get regions() { return this.face.regions; }

  weightsIn(region) { return this.face.weightsIn(region); }

  get [expression]() { return this.#expression; }
  get [shown]() { return this.#shown; }
  get [isGone]() { return this.#isGone; }

  look(pose) {
    this.face.look(pose);
    this.#expression = {};
  }

  setWeights(weights, region) {
    this[takeInfluences]();
    this.face.setWeights(weights, region);
    this.#tellInfluences();
  }

  reset() {
    this.face.reset();
    this.#tellInfluences();
  }

  moveTo(goals, drive, region) {
    this[takeInfluences]();
    this.face.moveTo(goals, drive, region);
    this.advance(0);  // cuts are there at once
  }

  push(name, velocityChange, drag) {
    this[takeInfluences]();
    this.face.push(name, velocityChange, drag);
    this.#moving = true;
  }

  /** Advances the face without showing it; returns whether anything still moves. */
  advance(seconds) {
    this[takeInfluences]();
    const moving = this.face.advance(seconds);
    if (moving || this.#moving) this.#tellInfluences();  // once more when it has stopped
    return this.#moving = moving;
  }

  /** Sets the weights whose influences others have set. Ignores values that are no weights, which others may write. */
  [takeInfluences]() {
    const set = [];
    for (const {mesh: {morphTargetInfluences: influences}, targets, told} of this.#followers)
      for (let k = 0; influences && k < told.length; ++k)
        if (influences[k] !== told[k] && targets[k] >= 0 && isWeight(influences[k])) set.push([targets[k], influences[k]]);
    if (set.length === 0) return;
    const {names} = this.face;
    this.face.setWeights(Object.fromEntries(set.map(([target, weight]) => [names[target], weight])));
    this.#tellInfluences();
  }

  /** Called when weights have changed: copies them to the influences, where there are any. */
  #tellInfluences() {
    const weights = this.face.weightValues;
    for (const {mesh, targets, told} of this.#followers) {
      const influences = mesh.morphTargetInfluences ?? [];
      for (let k = 0; k < targets.length; ++k) {
        const isThere = k < influences.length && targets[k] >= 0;
        if (isThere) Reflect.set(influences, k, weights[targets[k]]);  // a frozen array stays as it is
        told[k] = influences[k];  // which may be rounded, or missing
      }
    }
    for (const companion of this.#companions) this.#tellCompanion(companion, weights);
    this.#expression = {};
  }

  /** Copies weights that have changed to the influences of what is not the face, except those that others have set. */
  #tellCompanion({mesh: {morphTargetInfluences: influences}, targets, told, weights}, values) {
    for (let k = 0; influences && k < targets.length; ++k) {
      if (influences[k] !== told[k]) targets[k] = -1;
      if (targets[k] < 0 || values[targets[k]] === weights[k]) continue;
      Reflect.set(influences, k, weights[k] = values[targets[k]]);
      told[k] = influences[k];
    }
  }

  /**
   * Call it once a frame with the seconds since the last; costs nothing while nothing moves. Returns whether there is
   * something new to draw, or will be in the next frame.
   */
  update(seconds = 0) {
    if (this.#isGone) return false;
    this[takeInfluences]();
    if ((this.#moving && seconds > 0) || !Number.isFinite(seconds)) this.advance(seconds);
    this[follow]();
    const isNew = this.#shown !== this.#expression;
    if (isNew) this[show]();
    this.#shown = this.#expression;
    return isNew || this.#moving;
  }

  /** Prepares the face to move. Otherwise that happens at its first move, and takes a few frames. */
  prepare() { this.face.prepare(); }

  [follow]() {}

  [release]() {}

  dispose() {
    if (this.#isGone) return;
    this.#isGone = true;
    this[release]();
    this.face.dispose();
  }
};
