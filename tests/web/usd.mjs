// Files of USD as other programs read them: OpenUSD's own library and TinyUSDZ, both as WebAssembly in a browser.
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { modules, withPage } from './browser.mjs';
import { inWork, work } from './tool.mjs';

const folders = [work, fileURLToPath(modules)];

/** What OpenUSD makes of a file: its text, written anew, the sizes of its images, and what renderers get of the mesh. */
const openUsd = (page, name) => page.evaluate(async (name) => {
  const folder = '/three-usdz-loader/external';
  if (!window.getUsdModule)
    await new Promise((done) => {
      const script = Object.assign(document.createElement('script'), { src: `${folder}/emHdBindings.js`, onload: done });
      document.head.append(script);
    });
  const usd = await window.getUsdModule(undefined, folder);
  await usd.ready;
  const bytes = new Uint8Array(await (await fetch(name)).arrayBuffer()), drawn = {};
  const drawing = (file, content) => {
    const prim = new Proxy({}, { get: (_, call) => (...given) => { drawn[call] = [...given[0] ?? []]; } });
    const make = () => prim;
    usd.FS.createDataFile('/', file, content, true, true, true);
    return new usd.HdWebSyncDriver({ createRPrim: make, createBPrim: make, createSPrim: make, CommitResources() {} },
                                   file);
  };
  // This build knows no skeletons and does not draw what they hold.
  const still = new TextDecoder().decode(bytes).replace('def SkelRoot', 'def Xform');
  if (name.endsWith('.usda')) drawing('drawn.usda', new TextEncoder().encode(still)).Draw();
  const driver = drawing(`read${name.slice(name.lastIndexOf('.'))}`, bytes), written = driver.GetStage().ExportToString();
  const images = {};
  for (const [, image] of written.matchAll(/@(.*?)@/g))
    await new Promise((done) => driver.getFile(image, (bytes) => { images[image] = bytes?.length ?? 0; done(); }));
  return { written, images, points: drawn.updatePoints, normals: drawn.updateNormals,
           triangles: drawn.updateIndices };
}, name);

/** TinyUSDZ's complaints, which include what is wrong with skeletons and blend shapes. */
const tinyUsdz = (page, name) => page.evaluate(async (name) => {
  const { default: open } = await import('/tinyusdz/tinyusdz.js');
  const reader = new (await open()).TinyUSDZLoaderNative();
  const isRead = reader.loadFromBinary(new Uint8Array(await (await fetch(name)).arrayBuffer()), name);
  return isRead ? '' : reader.error();
}, name);

/** A value of USD: numbers, texts and paths, in lists and tuples. */
function parseValue(text) {
  if (text.startsWith('@')) return text.match(/^@(?:.*\[)?(.*?)\]?@$/)[1];  // OpenUSD adds its archive
  if (/["']/.test(text))  // single quotes are around texts with double quotes in them
    return JSON.parse(text.replace(/"(?:[^"\\]|\\.)*"|'((?:[^'\\]|\\.)*)'/g, (whole, single) =>
      single === undefined ? whole : `"${single.replace(/"/g, '\\"')}"`));
  return JSON.parse(text.replace(/\(/g, '[').replace(/\)/g, ']').replace(/<([^>]*)>/g, '"$1"'));
}

/** The prims in a text of USD by their paths, each with its type, metadata and values. The layer has the path ''. */
export function parseUsda(text) {
  const lines = text.split('\n').map((line) => line.trim()), prims = {};
  let at = 1, path = '';
  const metadata = () => {
    const list = [];
    for (; lines[at] !== ')'; ++at)  // this OpenUSD does not know displayName of prims, and drops it
      if (!lines[at].startsWith('displayName')) list.push(lines[at].replace('prepend ', ''));
    ++at;
    return list.join('\n');
  };
  at += lines.indexOf('(');
  prims[''] = { type: 'layer', metadata: metadata().replace(/doc = (""".*?"""|".*?")\n/s, ''), values: {} };
  while (at < lines.length) {
    let line = lines[at++];
    if (line.endsWith(' = [')) {  // OpenUSD writes a path a line
      while (lines[at] !== ']') line += lines[at++];
      line = `${line.replace(/,$/, '')}${lines[at++]}`;
    }
    const prim = line.match(/^def (\w+) "(\w+)"( \()?$/), samples = line.match(/^(.*)\.timeSamples = \{$/);
    const value = line.match(/^(.*?) = (.*?)( \()?$/);
    if (prim) {
      path += `/${prim[2]}`;
      prims[path] = { type: prim[1], metadata: prim[3] ? metadata() : '', values: {} };
      ++at;  // its brace
    } else if (line === '}') {
      path = path.slice(0, path.lastIndexOf('/'));
    } else if (samples) {
      const list = prims[path].values[`${samples[1]}.timeSamples`] = [];
      for (; lines[at] !== '}'; ++at) {
        const [, time, sample] = lines[at].match(/^(.*?): (.*),$/);
        list.push([Number(time), parseValue(sample)]);
      }
      ++at;
    } else if (value) {
      const parsed = parseValue(value[2]);
      prims[path].values[value[1]] = line.startsWith('rel ') ? [parsed].flat() : parsed;
      if (value[3]) prims[path].values[`${value[1]} (`] = metadata();
    } else if (line !== '') {
      prims[path].values[line] = null;
    }
  }
  return prims;
}

/** The text of a file of USD; in an archive that is the first file, and not compressed. */
function ownText(name) {
  const bytes = readFileSync(inWork(name));
  if (bytes.readUInt32LE() !== 0x04034b50) return bytes.toString('utf8');
  const start = 30 + bytes.readUInt16LE(26) + bytes.readUInt16LE(28);
  return bytes.toString('utf8', start, start + bytes.readUInt32LE(18));
}

/**
 * Reads files of the work folder with both: `own` is what stands in the file, `theirs` what OpenUSD wrote of it,
 * `complaints` what TinyUSDZ refuses.
 */
export async function readUsd(...names) {
  writeFileSync(inWork('index.html'), '<!doctype html><title>USD</title>');
  return withPage(folders, 'index.html', async (page) => {
    const results = [];
    for (const name of names) {
      const { written, ...drawn } = await openUsd(page, name);
      results.push({ ...drawn, own: parseUsda(ownText(name)), theirs: parseUsda(written),
                     complaints: await tinyUsdz(page, name) });
    }
    return results;
  }, { alone: true });
}
