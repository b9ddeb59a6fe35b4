// Whole scenes for three.js: what a glTF file held when it was converted (skeletons, materials, textures, other meshes,
// animations), with the face in it.
import {BufferAttribute, DynamicDrawUsage, LoaderUtils, Matrix3, Matrix4, Sphere} from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {Sweepface} from './sweepface.js';
import {withOptions} from './sweepface_file.js';
import {formatGlb, sceneOf} from './sweepface_glb.js';
import {begin, movedByWeights, show} from './sweepface_moved.js';
import {partsOf} from './sweepface_scene_parts.js';
import {bound, SweepfaceLoader} from './sweepface_three.js';
import {bytesOf} from './sweepface_values.js';

const UNFIT = 'The face and its scene do not fit; convert the source again.';

const emptyAccessor = ({accessors}, index) => index !== undefined && accessors[index].bufferView === undefined;
const primitiveOf = (json, {mesh, primitive}) => json.meshes[mesh].primitives[primitive];

/**
 * A copy of the scene's JSON in which targets have names but no shapes of their own: three.js then makes influences for
 * them, which cost nothing.
 */
function withoutShapes(given, parts) {
  const json = structuredClone(given);
  for (const part of parts) {
    const {POSITION} = primitiveOf(json, part).attributes, {mesh, names} = part;
    if (names.length === 0) continue;
    primitiveOf(json, part).targets = names.map(() => ({POSITION}));
    json.meshes[mesh].extras = {...json.meshes[mesh].extras, targetNames: names};
  }
  return json;
}

/** The vertices that parts share, which follow the face. */
class Run {
  #texcoords;
  #toMesh;  // from the space of the scene, unless they are the same

  constructor({first, count, world, mirrors}, {positions, normals}) {
    Object.assign(this, {first, count, mirrors});
    this.#toMesh = world.equals(new Matrix4()) ? null : world.clone().invert();
    const inScene = (array) => array.subarray(3 * first, 3 * (first + count));
    const own = (array) => (this.#toMesh ? new Float32Array(3 * count) : inScene(array));
    this.inScene = {position: inScene(positions), normal: inScene(normals)};
    this.position = new BufferAttribute(own(positions), 3).setUsage(DynamicDrawUsage);
    this.normal = new BufferAttribute(own(normals), 3).setUsage(DynamicDrawUsage);
  }

  /** Those of the face's texture coordinates that are of the run, with v downwards. */
  texcoords(all) {
    const own = new Float32Array(2 * this.count);
    for (let k = 0; all && k < own.length; k += 2) own.set([all[2 * this.first + k], 1 - all[2 * this.first + k + 1]], k);
    return this.#texcoords ??= new BufferAttribute(own, 2);
  }

  /** Brings the attributes up to date with the face's positions and normals. */
  update() {
    const {position, normal} = this;
    if (this.#toMesh) {
      position.array.set(this.inScene.position);
      normal.array.set(this.inScene.normal);
      position.applyMatrix4(this.#toMesh);
      normal.applyNormalMatrix(new Matrix3().getNormalMatrix(this.#toMesh));
    }
    position.needsUpdate = normal.needsUpdate = true;
  }
}

/** The face's triangles in the runs where they lie, as indices into these. In a mirrored mesh they are the other way round. */
function trianglesOf(face, runs) {
  const runOf = new Uint32Array(face.pointCount), {triangles, pointCount, copies} = face, found = runs.map(() => []);
  runs.forEach(({first, count}, r) => runOf.fill(r, first, first + count));
  const point = (vertex) => (vertex < pointCount ? vertex : copies[vertex - pointCount]);
  for (let k = 0; k < triangles.length; k += 3) {
    const r = runOf[point(triangles[k])], {first, mirrors} = runs[r];
    const [a, b, c] = [0, 1, 2].map((corner) => point(triangles[k + corner]) - first);
    found[r].push(a, mirrors ? c : b, mirrors ? b : c);
  }
  return found.map((indices) => Uint32Array.from(indices));
}

/** How many triangles of three different vertices a geometry has. */
function countTriangles({index, attributes: {position}}) {
  if (!index) return Math.floor(position.count / 3);
  let count = 0;
  for (let k = 0; k + 2 < index.count; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => index.getX(k + corner));
    count += a !== b && b !== c && c !== a;
  }
  return count;
}

/** Parts in the order in which the face lists its triangles: by material, in the order of their first use. */
function byMaterial(json, parts) {
  const materialOf = (part) => primitiveOf(json, part).material ?? -1;
  const materials = [...new Set(parts.map(materialOf))].filter((material) => material >= 0);
  const rank = (part) => materials.indexOf(materialOf(part));  // -1 if it has none, as the face has it
  return [...parts].sort((a, b) => rank(a) - rank(b));
}

/** The geometry that was made of each part, as a map from parts. */
async function geometriesOf({parser}, parts) {
  const found = new Map();
  for (const part of parts) {
    const mesh = await parser.getDependency('mesh', part.mesh);  // a group, if it has several primitives
    found.set(part, (mesh.geometry ? mesh : mesh.children[part.primitive]).geometry);
  }
  return found;
}

/** The face of a scene, whose meshes follow the weights. */
export class SceneFace extends movedByWeights(Object) {
  #arrays;
  #runs;
  #geometries;
  #scenes;

  /** `geometries` are those of the parts. */
  constructor(face, {scenes}, json, geometries) {
    super();
    const numbers = () => new Float32Array(3 * face.vertexCount);
    const runs = new Set([...geometries.keys()].map(({run}) => run));
    this.#arrays = {positions: numbers(), normals: numbers()};
    this.#runs = new Map([...runs].map((run) => [run, new Run(run, this.#arrays)]));
    this.#scenes = scenes;
    this.#geometries = new Set(geometries.values());
    this.#giveShapes(json, geometries, face);
    const index = new Map(face.names.map((name, k) => [name, k]));
    const targetsOf = new Map([...geometries].map(([{names}, geometry]) => {
      return [geometry, names.map((name) => index.get(name) ?? -1)];
    }));
    this[begin](face, this.meshes.map((mesh) => ({mesh, targets: targetsOf.get(mesh.geometry)})));
    this.update();
  }

  /** The meshes that show the face: several for a part where nodes share a mesh. */
  get meshes() {
    const found = new Set();
    for (const scene of this.#scenes)
      scene.traverse((object) => this.#geometries.has(object.geometry) && found.add(object));
    return [...found];
  }

  /** Gives the geometries what the scene leaves to the face. */
  #giveShapes(json, geometries, face) {
    const runs = [...this.#runs.values()], triangles = new Map(), {texcoords} = face;
    trianglesOf(face, runs).forEach((indices, r) => triangles.set(runs[r], {indices, taken: 0}));
    for (const part of byMaterial(json, [...geometries.keys()])) {
      const run = this.#runs.get(part.run), geometry = geometries.get(part), left = triangles.get(run);
      const {indices, attributes} = primitiveOf(json, part), isLeft = emptyAccessor(json, indices);
      const end = left.taken + (isLeft ? geometry.index.count : 3 * countTriangles(geometry));
      if (end > left.indices.length) throw new Error(UNFIT);
      if (isLeft) geometry.setIndex(new BufferAttribute(left.indices.subarray(left.taken, end), 1));
      left.taken = end;
      geometry.morphAttributes = {};
      geometry.setAttribute('position', run.position);
      if (geometry.attributes.normal) geometry.setAttribute('normal', run.normal);
      if (emptyAccessor(json, attributes.TEXCOORD_0)) geometry.setAttribute('uv', run.texcoords(texcoords));
      geometry.boundingBox = null;
      geometry.boundingSphere = new Sphere();
    }
  }

  [show]() {
    this.face.evaluate(this.#arrays.positions, this.#arrays.normals);
    for (const run of this.#runs.values()) run.update();
    for (const geometry of this.#geometries) {
      bound(geometry.attributes.position, geometry.boundingSphere);
      if (geometry.boundingBox) geometry.computeBoundingBox();
    }
  }

  /** Frees the face, and the geometries, materials and textures of the scene. */
  dispose() {
    super.dispose();
    const all = new Set();
    for (const scene of this.#scenes)
      scene.traverse(({geometry, material, skeleton}) => {
        for (const used of [geometry, skeleton, material].flat().filter(Boolean)) all.add(used);
      });
    for (const used of all) {
      for (const texture of Object.values(used).filter((value) => value?.isTexture)) texture.dispose();
      used.dispose();
    }
  }
}

const NO_SCENE = 'holds no scene, as it was made from a mesh without one or with --bare; load it by SweepfaceLoader.';

/** Throws if an option asks for other vertices than the source's, which the scene goes with. */
function checkDetail({lod, edgeLength, error, vertices}) {
  if (lod || [edgeLength, error, vertices].some((budget) => budget !== undefined))
    throw new TypeError('The meshes of a scene have the vertices of their source; leave out lod, edgeLength, error and vertices.');
}

/**
 * Loads a .sweep file with the scene that its face came with. What it promises is what GLTFLoader makes of a glTF file, and
 * `face`, which moves the meshes in it.
 */
export class SweepfaceSceneLoader extends SweepfaceLoader {
  /** `options` are those of Sweepface.load, and `gltfLoader`, a GLTFLoader that has decoders or plugins of its own. */
  async parseAsync(given, options = {}, usual = this.options) {
    const {gltfLoader = new GLTFLoader(this.manager), ...others} = withOptions(usual, options);
    const {name = 'The face'} = others, bytes = bytesOf(given)?.slice();  // the caller may change it meanwhile
    checkDetail(others);
    const face = await Sweepface.load(bytes, others);
    try {
      const scene = await sceneOf(bytes, name);
      if (!scene) throw new Error(`${name} ${NO_SCENE}`);
      const {parts, vertices} = partsOf(scene.json);
      if (vertices !== face.pointCount) throw new Error(`${name}: ${UNFIT}`);
      const json = withoutShapes(scene.json, parts), folder = this.resourcePath || LoaderUtils.extractUrlBase(name);
      const gltf = await gltfLoader.parseAsync(formatGlb({...scene, json}), folder);
      return Object.assign(gltf, {face: new SceneFace(face, gltf, json, await geometriesOf(gltf, parts))});
    } catch (error) {
      face.dispose();
      throw error;
    }
  }
}
