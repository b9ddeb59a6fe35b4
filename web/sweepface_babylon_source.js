// Where faces for Babylon.js come from.
import {ownOptions} from './sweepface_regions.js';
import {Sweepface} from './sweepface.js';
import {nameOf} from './sweepface_values.js';

async function download(url) {
  const answer = await fetch(url);
  if (answer.ok) return answer.arrayBuffer();
  const {status, statusText} = answer;
  throw new Error(`${nameOf(url)} cannot be loaded: the server answers ${status} ${statusText}`.trimEnd() + '.');
}

/** The name of the file at a URL, without its folders and query; other URLs, such as data:, have none. */
export const nameIn = (url = '') => (/^(data|blob):/i.test(url) ? '' : nameOf(url).split('/').pop()) || 'face';

export function checkScene(scene) {
  if (typeof scene?.getEngine !== 'function')
    throw new TypeError('A mesh takes the scene that it belongs to, and what else it takes after that.');
}

/**
 * Loads from a URL or from bytes: `make` is given the bytes, `load`, the other options and the URL, if there is one. A
 * scene, if there is one, is not ready before.
 */
export async function loadFor(scene, source, options, make) {
  if (scene) checkScene(scene);
  const {load = Sweepface.load, ...usual} = ownOptions(options);
  const url = typeof source === 'string' || source instanceof URL ? String(source) : undefined;
  if (url !== undefined) usual.name ??= nameOf(url);
  scene?.addPendingData(usual);  // its whenReadyAsync() waits
  try {
    return await make(url === undefined ? source : await download(url), load, usual, url);
  } finally {
    scene?.removePendingData(usual);
  }
}
