// Whole scenes for Babylon.js: what a glTF file held when it was converted, with the face in it.
import '@babylonjs/loaders/glTF/2.0/index.js';
import {EngineStore} from '@babylonjs/core/Engines/engineStore.js';
import {LoadAssetContainerAsync} from '@babylonjs/core/Loading/sceneLoader.js';
import {SceneFace} from './sweepface_babylon_face.js';
import {checkScene, loadFor} from './sweepface_babylon_source.js';
import {formatGlb} from './sweepface_glb.js';
import {isEmpty} from './sweepface_scene_left.js';
import {withScene} from './sweepface_scene_read.js';

export {SceneFace};

/** Targets that hold nothing: Babylon.js makes influences for them. */
const HOLLOW = () => ({});

/** The folder of a URL, beside which files that a scene names are looked for. */
const folderOf = (url = '') => url.split(/[?#]/)[0].replace(/[^/]*$/, '');

/**
 * A copy of a scene's JSON for Babylon.js: without the indices that it leaves to the face, which would be looked for, and
 * without coarser levels of detail, which would be shown first and replaced at any time.
 */
function prepared({json, parts}) {
  const copy = structuredClone(json);
  for (const {mesh, primitive} of parts) {
    const own = copy.meshes[mesh].primitives[primitive];
    if (isEmpty(json, own.indices)) delete own.indices;
  }
  for (const {extensions} of [...copy.nodes ?? [], ...copy.materials ?? []]) delete extensions?.MSFT_lod;
  return copy;
}

/** What Babylon.js makes of a scene. */
async function containerOf(scene, world, options, name) {
  const bytes = new Uint8Array(formatGlb({...scene, json: prepared(scene)}));
  try {
    const container = await LoadAssetContainerAsync(bytes, world, {...options, pluginExtension: '.glb', name});
    if (!world.isDisposed) return container;
    container.dispose();
  } catch (cause) {
    if (!world.isDisposed) throw new Error(`${name}: its scene cannot be shown: ${cause.message}`, {cause});
  }
  throw new Error('The scene was disposed of while the face was loading.');
}

/** What Babylon.js makes of a scene, in its own, with the face in it. */
async function shownIn(world, options, face, scene, name) {
  const container = await containerOf(scene, world, options, name);
  try {
    const made = new SceneFace(face, container, scene, name);
    container.addAllToScene();
    const {meshes, transformNodes, skeletons, animationGroups, lights, cameras} = container;
    return {face: made, container, meshes, transformNodes, skeletons, animationGroups, lights, cameras};
  } catch (error) {
    container.dispose();
    throw error;
  }
}

/**
 * Loads a .sweep file from a URL, or from bytes, with the scene that its face came with. `options` are those of
 * Sweepface.load, `load`, loadInWorker, and `pluginOptions`, those of Babylon.js for loaders. Returns what Babylon.js makes
 * of a glTF file, and `face`, which moves the meshes in it.
 */
export async function importScene(source, scene, options = {}) {
  const world = scene ?? EngineStore.LastCreatedScene;
  checkScene(world);
  return loadFor(world, source, options, (bytes, load, {pluginOptions, ...usual}, url) => {
    const show = (...made) => shownIn(world, {pluginOptions, rootUrl: folderOf(url)}, ...made);
    return withScene(bytes, load, usual, {hollow: HOLLOW, alone: 'SweepfaceMesh.load'}, show);
  });
}
