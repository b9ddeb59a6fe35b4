// What the native tool says, to compare with. SWEEPFACE_TOOL and SWEEPFACE_SAMPLE may name another tool and another
// sample face than those that `make web` makes.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
export const tool = process.env.SWEEPFACE_TOOL ?? here('../../build/release/sweepface');
export const sample = process.env.SWEEPFACE_SAMPLE ?? here('../sample.sweep');
const corpus = here('../../fuzz/corpus/sweep');

/** Every .sweep file to try: the sample face and small ones of every sort. */
export function everyFile() {
  return [sample, ...readdirSync(corpus).filter((name) => name.endsWith('.sweep')).map((name) => join(corpus, name))];
}

const frame = process.env.SWEEPFACE_FRAME ?? here('../../build/release/web/test/web_frame');

/** Positions and normals of an expression as the native C interface plays them, and how far off they may be. */
export function played(file, weights, lod) {
  const bytes = execFileSync(frame, [file, lod, ...Object.values(weights)], {maxBuffer: 1 << 28});
  const floats = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const half = (floats.length - 1) / 2;
  return {positions: floats.subarray(0, half), normals: floats.subarray(half, 2 * half), error: floats[2 * half]};
}

/** Positions and normals of an expression in double precision, as the tool exports them. */
export function exported(file, weights, lod, options = []) {
  const folder = mkdtempSync(join(tmpdir(), 'sweepface-'));
  try {
    const out = join(folder, 'out.obj'), list = Object.entries(weights).map(([name, weight]) => `${name}=${weight}`);
    execFileSync(tool, ['export', file, '-o', out, '--quiet', '--weights', list.join(','), ...(lod ? ['--lod', lod] : []), ...options]);
    const positions = [], normals = [];
    for (const line of readFileSync(out, 'utf8').split('\n')) {
      const [keyword, ...numbers] = line.split(' ');
      if (keyword === 'v') positions.push(...numbers.map(Number));
      if (keyword === 'vn') normals.push(...numbers.map(Number));
    }
    return {positions, normals};
  } finally {
    rmSync(folder, {recursive: true});
  }
}

/** The sample face with what its targets turn about. */
export function withArcs() {
  const folder = mkdtempSync(join(tmpdir(), 'sweepface-'));
  process.on('exit', () => rmSync(folder, {recursive: true}));
  const drawing = join(folder, 'sample.wire.json'), file = join(folder, 'arcs.sweep');
  execFileSync(tool, ['wireframe', sample, '-o', drawing, '--quiet']);
  execFileSync(tool, ['build', drawing, '--source', sample, '--arcs', '-o', file, '--quiet']);
  return file;
}

/** A weight for every expression, none like another. */
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
