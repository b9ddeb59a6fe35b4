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

/** Positions and normals of an expression in double precision, as the tool exports them. */
export function exported(file, weights, lod) {
  const folder = mkdtempSync(join(tmpdir(), 'sweepface-'));
  try {
    const out = join(folder, 'out.obj'), list = Object.entries(weights).map(([name, weight]) => `${name}=${weight}`);
    execFileSync(tool, ['export', file, '-o', out, '--quiet', '--weights', list.join(','), ...(lod ? ['--lod', lod] : [])]);
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

/** A weight for every expression, none like another. */
export function someWeights(names) {
  return Object.fromEntries(names.map((name, k) => [name, ((7 * k + 3) % 11) / 10 - 0.2]));
}

/** A float as an integer that grows by one from float to float. */
function place(x) {
  const bits = new Int32Array(new Float32Array([x]).buffer)[0];
  return bits < 0 ? -(bits & 0x7fffffff) : bits;
}

/** By how many floats two arrays differ at most, and how many numbers differ. */
export function difference(doubles, floats) {
  let most = 0, count = 0;
  doubles.forEach((x, k) => {
    const steps = Math.abs(place(Math.fround(x)) - place(floats[k]));
    most = Math.max(most, steps);
    count += steps > 0;
  });
  return {most, count};
}
