// Plays .sweep faces in browsers and in Node.
import {DRIVE_SIZE, writeDrive} from './sweepface_drives.js';
import {open, Shared} from './sweepface_file.js';
import {checkTime, isFloats, isGiven, kindOf, known, MOST, overlap, told} from './sweepface_values.js';
import {MemoryError} from './sweepface_wasm.js';

const copyOf = ({leftEye, rightEye}) => ({leftEye: {...leftEye}, rightEye: {...rightEye}});

/** Frees what a face has of its own. What the faces of a file share goes with their runtime. */
function free({runtime}, {face, motion, memory}) {
  const {wasm} = runtime;
  if (runtime.isDead) return;
  wasm.sweepface_motion_free(motion);
  wasm.sweepface_face_free(face);
  wasm.free(memory.positions);
}

/** Frees faces that nobody disposed of before they were collected, as frameworks drop what they render twice. */
const forgotten = new FinalizationRegistry(({shared, own}) => free(shared, own));

export class Sweepface {
  #shared;
  #own = {face: 0, motion: 0, memory: null};  // addresses in the module's memory
  #pose = null;

  /** Use Sweepface.load. */
  constructor(shared) {
    if (!(shared instanceof Shared)) throw new TypeError('Faces are made by Sweepface.load.');
    const {runtime, vertexCount, weightCount} = shared;
    this.#shared = shared;
    const positions = runtime.allocate(24 * vertexCount + 8 * weightCount + DRIVE_SIZE + 16);
    const normals = positions + 12 * vertexCount, weights = positions + 24 * vertexCount;
    const drive = weights + 8 * weightCount, vectors = drive + DRIVE_SIZE;
    // One block: float arrays, weights, C structs of a drive and two vectors.
    this.#own.memory = {positions, normals, weights, drive, vectors};
    this.#own.face = runtime.get('sweepface_face_create', shared.mesh);
    forgotten.register(this, {shared, own: this.#own}, this);
  }

  static async load(bytes, options) {
    return new Sweepface(await open(bytes, options));
  }

  /** Another face of the same file, at rest; the two share everything but their weights. */
  clone() {
    return new Sweepface(this.#open());
  }

  get names() { return [...this.#open().names]; }
  get lod() { return this.#open().lod; }
  get tolerance() { return this.#open().runtime.wasm.sweepface_rig_tolerance(this.#shared.rig); }
  get turnCount() { return this.#open().turnCount; }
  get pointCount() { return this.#open().runtime.wasm.sweepface_mesh_point_count(this.#shared.mesh); }
  get vertexCount() { return this.#open().vertexCount; }
  get triangles() { return this.#open().triangles(); }
  get texcoords() { return this.#open().texcoords(); }
  get parts() { return this.#open().parts(); }
  /** Bytes of WebAssembly memory that the file and all its faces hold. */
  get memoryBytes() { return this.#open().runtime.wasm.memory.buffer.byteLength; }

  /** The regions in the order of their weights; empty if the face is not divided. */
  get regions() { return this.#open().regions?.map(({name}) => name) ?? []; }

  /** The weights by name; of a divided face, those of the first region. */
  get weights() { return this.#weightsOf(0); }
  weightsIn(region) { return this.#weightsOf(this.#open().region(region)); }

  /** The same in the order of the names, which is cheaper to get every frame. */
  get weightValues() { return this.#valuesOf(0); }

  #weightsOf(region) {
    const values = this.#valuesOf(region);
    return Object.fromEntries(this.#shared.names.map((name, k) => [name, values[k]]));
  }

  #valuesOf(region) {
    const {runtime, names: {length}} = this.#open(), all = runtime.wasm.sweepface_face_weights(this.#own.face);
    return runtime.doubles(all + 8 * length * region, length).slice();
  }

  /** Sets the named weights, everywhere or in a region, and stops their motion; leaves the others alone. */
  setWeights(weights, region) {
    const shared = this.#open(), {runtime, names} = shared, {wasm} = runtime, count = names.length;
    const named = this.#resolve(weights), places = shared.places(region);
    if (named.length === 0) return;
    shared.loadTargets();
    const all = this.#copyWeights();
    for (const r of places)
      for (const [target, weight] of named) all[count * r + target] = weight;
    this.#takeWeights();
    if (!this.#own.motion) return;
    const cut = shared.regions ? 0 : this.#drive('cut');
    for (const r of places)
      for (const [target, weight] of named)
        runtime.check(shared.regions ? wasm.sweepface_motion_put_in(this.#own.motion, r, target, weight)
                                     : wasm.sweepface_motion_move_to(this.#own.motion, target, weight, cut));
  }

  /** Copies the current weights of all regions to the face's block of memory. */
  #copyWeights() {
    const {runtime, weightCount} = this.#shared, all = runtime.doubles(this.#own.memory.weights, weightCount);
    all.set(runtime.doubles(runtime.wasm.sweepface_face_weights(this.#own.face), weightCount));
    return all;
  }

  /** Sets the face's weights from that copy. */
  #takeWeights() {
    const {runtime, names, regions} = this.#shared, {wasm} = runtime, at = this.#own.memory.weights, count = names.length;
    if (!regions) return runtime.check(wasm.sweepface_face_set_weights(this.#own.face, at, count));
    regions.forEach((_, r) => {
      runtime.check(wasm.sweepface_face_set_region_weights(this.#own.face, r, at + 8 * count * r, count));
    });
  }

  /** Sets all weights to 0, at once. */
  reset() {
    this.setWeights(Object.fromEntries(this.#open().names.map((name) => [name, 0])));
  }

  /** How many eyeballs turn. */
  get eyeCount() { return this.#open().eyeCount; }

  /** The pose that `look` was given, or null. */
  get pose() { return this.#open() && this.#pose && copyOf(this.#pose); }

  /** Turns the eyes: {leftEye: {yaw, pitch}, rightEye: {yaw, pitch}} in radians; null: by the eyeLook weights. */
  look(pose) {
    const {runtime, eyeCount} = this.#open();
    if (eyeCount === 0) throw new Error('The face has no eyes that turn; load it with the option eyes, if it has any.');
    const angles = (eye, name) => {
      const {yaw = 0, pitch = 0, roll = 0} = known(eye, ['yaw', 'pitch', 'roll'], `look's ${name}`);  // as clips have it
      for (const angle of [yaw, pitch, roll])
        if (!Number.isFinite(angle)) throw new TypeError(`look's ${name} takes finite numbers, not ${told(angle)}.`);
      return [yaw, pitch, 0];
    };
    if (!isGiven(pose)) {
      runtime.check(runtime.wasm.sweepface_face_look(this.#own.face, 0));
      this.#pose = null;
      return;
    }
    const {leftEye, rightEye} = known(pose, ['leftEye', 'rightEye'], 'look');
    const numbers = new Float64Array([0, 0, 0, ...angles(leftEye, 'leftEye'), ...angles(rightEye, 'rightEye')]);
    runtime.lend(new Uint8Array(numbers.buffer), (at) => {
      runtime.check(runtime.wasm.sweepface_face_look(this.#own.face, at));
    });
    this.#pose = copyOf(pose);
  }

  /** Writes positions and normals, three floats a vertex; either may be null. */
  evaluate(positions, normals = null) {
    const {runtime, vertexCount} = this.#open(), memory = this.#own.memory;
    const count = 3 * vertexCount;
    for (const out of [positions, normals].filter(isGiven)) {
      if (!isFloats(out))
        throw new TypeError(`Positions and normals are written to a Float32Array, a Float64Array or null, not to ${kindOf(out)}.`);
      if (out.length < count)
        throw new RangeError(`There must be room for ${vertexCount} vertices: ${count} numbers, not ${out.length}.`);
    }
    if (positions && normals && overlap(positions, normals, count))
      throw new RangeError('Positions and normals must be written to different places.');
    runtime.words(memory.vectors, 4).set([positions ? memory.positions : 0, 0, normals ? memory.normals : 0, 0]);
    runtime.check(runtime.wasm.sweepface_face_update(this.#own.face, vertexCount, memory.vectors, memory.vectors + 8));
    positions?.set(runtime.floats(memory.positions, count));
    normals?.set(runtime.floats(memory.normals, count));
  }

  /** The constant tables from which a vertex shader evaluates the face, instead of `evaluate`: see shaderModes. */
  shaderTables(tangents = false) {
    const {runtime} = this.#open(), {wasm} = runtime, points = this.pointCount, rows = tangents ? 2 : 1;
    this.#shared.loadTargets();
    return runtime.room(20, (out) => {
      runtime.check(wasm.sweepface_mesh_shader_tables(this.#shared.mesh, tangents ? 1 : 0, out));
      const [basis, places, neutral, texels, modes] = runtime.words(out, 5);
      return {
        basis: runtime.shorts(basis, 4 * texels).slice(),
        places: runtime.words(places, 3 * points).slice(),
        neutral: runtime.floats(neutral, 3 * points * rows).slice(),
        modes
      };
    });
  }

  /** Writes the modes, which change every frame, as four integers each; returns their common factor. */
  shaderModes(out, tangents = false) {
    const {runtime} = this.#open();
    if (kindOf(out) !== 'Int16Array') throw new TypeError(`Modes are written to an Int16Array, not to ${kindOf(out)}.`);
    if (out.length % 4 !== 0) throw new RangeError(`Modes are four numbers each, not ${out.length} together.`);
    this.#shared.loadTargets();
    return runtime.room(4 + 2 * out.length, (at) => {
      runtime.check(
        runtime.wasm.sweepface_face_modes(this.#own.face, tangents ? 1 : 0, at + 4, out.length / 4, at));
      out.set(runtime.shorts(at + 4, out.length));
      return runtime.floats(at, 1)[0];
    });
  }

  /** For each vertex after the points, the point that it duplicates. */
  get copies() { return this.#open().copies(); }

  /** Prepares the face to move. Otherwise that happens at its first move, and takes a few frames. */
  prepare() {
    this.#open().prepare();
  }

  /** Starts moving weights from where they stand to goals, everywhere or in a region; `advance` moves them. */
  moveTo(goals, drive, region) {
    const shared = this.#open(), {runtime} = shared, {wasm} = runtime;
    const all = this.#resolve(goals), places = shared.places(region);
    const at = this.#drive(drive, places), motion = this.#moving();  // all is checked before any sets out
    for (const [target, goal] of all)
      runtime.check(region === undefined ? wasm.sweepface_motion_move_to(motion, target, goal, at)
                                         : wasm.sweepface_motion_move_in(motion, places[0], target, goal, at));
  }

  /** An impulse: adds to a weight's velocity (per second), which drag (per second) then reduces. */
  push(name, velocityChange, drag = 8) {
    const shared = this.#open(), {runtime} = shared, target = shared.target(name);
    if (!Number.isFinite(velocityChange) || Math.abs(velocityChange) > MOST)
      throw new RangeError(`The push on '${name}' must lie within ${MOST} of 0, not be ${told(velocityChange)}.`);
    if (!Number.isFinite(drag) || drag < 0)
      throw new RangeError(`The drag on a push must be a finite number of at least 0, not ${told(drag)}.`);
    runtime.check(runtime.wasm.sweepface_motion_push(this.#moving(), target, velocityChange, drag));
  }

  /** Advances the weights in motion; returns whether anything still moves. */
  advance(seconds) {
    const {runtime, weightCount: count} = this.#open(), {wasm} = runtime, {weights} = this.#own.memory;
    checkTime(seconds);
    if (!this.#own.motion) return false;
    const still = 1e-6, before = this.#copyWeights().slice(), {motion} = this.#own;
    const isMoving = wasm.sweepface_motion_moves(motion, still) === 1;
    wasm.sweepface_motion_advance(motion, seconds);
    runtime.check(wasm.sweepface_motion_positions(motion, weights, count));
    const now = runtime.doubles(weights, count);
    now.set(now.map((weight) => Math.min(Math.max(weight, -MOST), MOST)));  // springs and pushes may overshoot
    this.#takeWeights();
    return isMoving || runtime.doubles(weights, count).some((w, k) => Math.abs(w - before[k]) > still);
  }

  /** Frees the face; it can no longer be used. Memory is given back with the last face of a file. */
  dispose() {
    if (!this.#shared) return;
    forgotten.unregister(this);
    free(this.#shared, this.#own);
    this.#shared = undefined;
  }

  #open() {
    if (!this.#shared) throw new Error('The face was disposed of.');
    if (this.#shared.runtime.isDead) throw new MemoryError();
    return this.#shared;
  }

  /** Pairs of target and value. Throws if any is invalid, so that nothing is set before all are known. */
  #resolve(byName) {
    if (typeof byName !== 'object' || !byName || Symbol.iterator in byName)
      throw new TypeError('Weights are given by name, like {jawOpen: 0.7}.');
    return Object.entries(byName).map(([name, value]) => {
      const target = this.#shared.target(name);
      if (!Number.isFinite(value))
        throw new TypeError(`The weight of '${name}' must be a finite number, not ${told(value)}.`);
      if (Math.abs(value) > MOST) throw new RangeError(`The weight of '${name}' must lie within ${MOST} of 0.`);
      return [target, value];
    });
  }

  #moving() { return this.#own.motion ||= this.#makeMotion(); }

  #makeMotion() {
    const {runtime, names, regions} = this.#shared, {wasm} = runtime, count = names.length;
    this.#shared.loadTargets();
    const weights = wasm.sweepface_face_weights(this.#own.face);
    if (!regions) return runtime.get('sweepface_motion_create', weights, count);
    const matters = new Float64Array(regions.flatMap(({mass, stiffness, delay}) => [mass, stiffness, delay]));
    const motion = runtime.lend(new Uint8Array(matters.buffer), (at) => {
      return runtime.get('sweepface_motion_create_regions', weights, count, at, regions.length);
    });
    this.#copyWeights().slice().forEach((weight, k) => {
      runtime.check(wasm.sweepface_motion_put_in(motion, Math.floor(k / count), k % count, weight));
    });
    return motion;
  }

  /** The address of a drive's C struct, valid until the next call. */
  #drive(drive, places = []) {
    const {runtime, regions} = this.#shared, at = this.#own.memory.drive;
    writeDrive(runtime, at, drive, places.map((r) => regions?.[r]));
    return at;
  }
}
