// Faces, and the native tool's results for them to compare with. SWEEPFACE_TOOL and SWEEPFACE_SAMPLE
// may name a tool and a sample face other than those that `make web` makes.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
export const tool = process.env.SWEEPFACE_TOOL ?? here('../../build/release/sweepface');
export const sample = process.env.SWEEPFACE_SAMPLE ?? here('../sample.sweep');
const corpus = here('../../fuzz/corpus/sweep');

const scratch = mkdtempSync(join(tmpdir(), 'sweepface-'));
process.on('exit', () => rmSync(scratch, {recursive: true}));

/** A folder that is removed when the tests end. */
export function newFolder() {
  return mkdtempSync(join(scratch, 'folder-'));
}

/** Every .sweep file to try: the sample face and small ones of every sort. */
export function everyFile() {
  return [sample, ...readdirSync(corpus).filter((name) => name.endsWith('.sweep')).map((name) => join(corpus, name))];
}

const frame = process.env.SWEEPFACE_FRAME ?? here('../../build/release/web/test/web_frame');

/** Positions and normals of an expression as the native C interface evaluates them, and how far off they may be. */
export function played(file, weights, lod) {
  const bytes = execFileSync(frame, [file, lod, ...Object.values(weights)], {maxBuffer: 1 << 28});
  const floats = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const half = (floats.length - 1) / 2;
  return {positions: floats.subarray(0, half), normals: floats.subarray(half, 2 * half), error: floats[2 * half]};
}

/** Positions and normals of an OBJ file, three numbers a vertex. */
export function readObj(file) {
  const positions = [], normals = [];
  for (const line of readFileSync(file, 'utf8').split('\n')) {
    const [keyword, ...numbers] = line.split(' ');
    if (keyword === 'v') positions.push(...numbers.map(Number));
    if (keyword === 'vn') normals.push(...numbers.map(Number));
  }
  return {positions, normals};
}

/** Positions and normals of an expression in double precision, as the tool exports them. */
export function exported(file, weights, lod, options = []) {
  const out = join(newFolder(), 'out.obj');
  const list = Object.entries(weights).map(([name, weight]) => `${name}=${weight}`).join(',');
  const detail = lod ? ['--lod', lod] : [];
  execFileSync(tool, ['export', file, '-o', out, '--quiet', '--weights', list, ...detail, ...options]);
  return readObj(out);
}

const once = (make) => {
  let made;
  return () => made ??= make();
};

/** A small file: the sample face with two of its targets, packed. */
export const packed = once(() => {
  const folder = newFolder(), file = join(folder, 'packed.sweep'), names = ['neutral', 'jawOpen', 'mouthSmileLeft'];
  for (const name of names)
    execFileSync(tool, ['export', sample, '-o', join(folder, `${name}.obj`), '--quiet',
                        ...(name === 'neutral' ? [] : ['--weights', `${name}=1`])]);
  const [neutral, ...targets] = names.map((name) => join(folder, `${name}.obj`));
  execFileSync(tool, ['convert', neutral, ...targets, '-o', file, '--tolerance', '0.05', '--pack', '--quiet']);
  return file;
});

/** A file of the sample face that says what its targets turn about. */
export const withArcs = once(() => {
  const folder = newFolder(), drawing = join(folder, 'sample.wire.json'), file = join(folder, 'arcs.sweep');
  execFileSync(tool, ['wireframe', sample, '-o', drawing, '--quiet']);
  execFileSync(tool, ['build', drawing, '--source', sample, '--arcs', '-o', file, '--quiet']);
  return file;
});

/** The vertices of a face in its current pose. */
export function positionsOf(face) {
  const positions = new Float32Array(3 * face.vertexCount);
  face.evaluate(positions);
  return positions;
}

/** A weight for every expression, varied. */
export function someWeights(names) {
  return Object.fromEntries(names.map((name, k) => [name, ((7 * k + 3) % 11) / 10 - 0.2]));
}

/** The largest difference between two arrays, and how many numbers differ. */
export function difference(a, b) {
  let most = 0, count = 0;
  a.forEach((x, k) => {
    most = Math.max(most, Math.abs(x - b[k]));
    count += x !== b[k];
  });
  return {most, count};
}
