// The scene in a .sweep file, as loaders of engines need it.
import {parted} from './sweepface_chunks.js';
import {damaged, sceneFrom} from './sweepface_glb.js';
import {unfit, withoutShapes} from './sweepface_scene_left.js';
import {partsOf} from './sweepface_scene_parts.js';
import {bytesOf} from './sweepface_values.js';

/** Throws if an option asks for other vertices than the source's, which the scene goes with. */
function checkDetail({lod, edgeLength, error, vertices}) {
  if (lod || [edgeLength, error, vertices].some((budget) => budget !== undefined))
    throw new TypeError('The meshes of a scene have the vertices of their source; ' +
                        'leave out lod, edgeLength, error and vertices.');
}

/**
 * The scene in a text: its JSON without shapes, its binary part, and which parts of it are the face. `hollow` makes targets
 * for a primitive; `alone` is what loads faces without a scene.
 */
async function readScene(text, name, {hollow, alone}) {
  if (!text)
    throw new Error(`${name} holds no scene, as it was made from a mesh without one or with --bare; load it by ${alone}.`);
  const scene = await sceneFrom(text, name);
  if (!scene.json.scenes?.length)
    throw new Error(`${name}: its glTF file has nodes, but no scene of them; load the face alone by ${alone}.`);
  try {
    const {parts, vertices} = partsOf(scene.json);
    return {...scene, json: withoutShapes(scene.json, parts, hollow), parts, vertices};
  } catch (cause) {
    throw damaged(name, cause);
  }
}

/**
 * What `make` makes of a face, the scene that it came with and a name for messages; the face is freed if that fails. `load`
 * loads the face with `options`; `how` is what readScene takes.
 */
export async function withScene(given, load, options, how, make) {
  const name = options.name || 'The face', bytes = bytesOf(given), {rest, text} = bytes ? parted(bytes) : {};
  checkDetail(options);
  const face = await load(rest, options);
  try {
    const scene = await readScene(text, name, how);
    if (scene.vertices !== face.pointCount) throw unfit(name);
    return await make(face, scene, name);
  } catch (error) {
    face.dispose();
    throw error;
  }
}
