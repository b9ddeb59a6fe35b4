// Whole scenes for three.js: what a glTF file held when it was converted (skeletons, materials, textures, other meshes,
// animations), with the face in it.
import {BufferAttribute} from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {apart} from './sweepface_animation.js';
import {parted} from './sweepface_chunks.js';
import {card} from './sweepface_followers.js';
import {formatGlb, sceneFrom} from './sweepface_glb.js';
import {SceneFace} from './sweepface_scene_face.js';
import {leftOf} from './sweepface_scene_left.js';
import {withScene} from './sweepface_scene_read.js';
import {meshFrom, settings, SweepfaceLoader} from './sweepface_three.js';
import {bytesOf, isGiven} from './sweepface_values.js';

export {SceneFace};

/** Targets that hold nothing of their own: three.js makes influences for them. */
const HOLLOW = ({attributes: {POSITION}}) => ({POSITION});

/** The JSON of the glTF file that a face came with, or null if there is no scene in the file. */
export async function sceneJson(given, name = 'The face') {
  const bytes = bytesOf(given);
  if (!bytes) throw new TypeError('sceneJson needs the bytes of a .sweep file: an ArrayBuffer or a typed array.');
  const {text} = parted(bytes);
  return text ? (await sceneFrom(text, name)).json : null;
}

/** What GLTFLoader makes of a scene. */
async function parse(scene, loader, folder, name) {
  try {
    return await loader.parseAsync(formatGlb(scene), folder);
  } catch (cause) {
    throw new Error(`${name}: its scene cannot be shown: ${cause.message}`, {cause});
  }
}

/** The geometry that three.js made of each part, as a map from parts. */
async function geometriesOf({parser}, parts) {
  const found = new Map();
  for (const part of parts) {
    const mesh = await parser.getDependency('mesh', part.mesh);  // a group, if it has several primitives
    found.set(part, (mesh.geometry ? mesh : mesh.children[part.primitive]).geometry);
  }
  return found;
}

/** Gives geometries, a map from parts, what the scene leaves to the face. */
function fill({json, parts}, geometries, face, name) {
  const shapeOf = (part) => {
    const {index, attributes: {position}} = geometries.get(part);
    return {indices: index?.array, vertexCount: position.count};
  };
  const uvs = new Map();  // attributes that parts have in common
  for (const [part, {indices, texcoords}] of leftOf(json, parts, shapeOf, face, name)) {
    const geometry = geometries.get(part);
    if (indices) geometry.setIndex(new BufferAttribute(indices, 1));
    if (!texcoords) continue;
    if (!uvs.has(texcoords)) uvs.set(texcoords, new BufferAttribute(texcoords, 2));
    geometry.setAttribute('uv', uvs.get(texcoords));
  }
}

/**
 * Loads a .sweep file with the scene that its face came with. What it promises is what GLTFLoader makes of a glTF file,
 * and `face`, which moves the meshes in it.
 */
export class SweepfaceSceneLoader extends SweepfaceLoader {
  /** A loader for the scene, where none is given. */
  #gltfLoader() {
    const {manager, crossOrigin, requestHeader, withCredentials} = this;
    return new GLTFLoader(manager).setCrossOrigin(crossOrigin).setRequestHeader(requestHeader)
        .setWithCredentials(withCredentials);
  }

  /**
   * `options` are those of Sweepface.load, `gltfLoader`, a GLTFLoader that has decoders or plugins of its own, `mesh`, the
   * class of meshes that evaluate vertices as those of the scene are to, and `load`, loadInWorker.
   */
  async parseAsync(given, options, usual = this.options, folder = '') {
    const {load, others: {gltfLoader, mesh, ...others}} = settings(usual, options);
    if (isGiven(gltfLoader) && typeof gltfLoader.parseAsync !== 'function')
      throw new TypeError("The option 'gltfLoader' is a GLTFLoader.");
    const way = meshFrom(mesh)[card];
    return withScene(given, load, others, {hollow: HOLLOW, alone: 'SweepfaceLoader'}, async (face, scene, name) => {
      const gltf = await parse(scene, gltfLoader ?? this.#gltfLoader(), this.resourcePath || folder, name);
      const geometries = await geometriesOf(gltf, scene.parts);
      fill(scene, geometries, face, name);
      const parts = new Map([...geometries].map(([part, geometry]) => [geometry, part]));
      const animations = gltf.animations.map((animation) => apart(animation, gltf.scene));
      return Object.assign(gltf, {animations, face: new SceneFace(face, gltf.scenes, parts, way)});
    });
  }
}

/** Another model like one that was loaded, in the same pose, that moves by itself. They share materials and textures. */
export function cloneScene({scene, face, animations} = {}) {
  if (!(face instanceof SceneFace)) throw new TypeError('cloneScene takes what a SweepfaceSceneLoader loaded.');
  return {...face.cloneIn(scene), animations};
}
