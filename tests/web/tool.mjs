// Runs the sweepface tool and reads what it writes, for tests of other programs on its files.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';

/** A folder that is deleted when the tests end. */
export const work = mkdtempSync(path.join(tmpdir(), 'sweepface-web-'));
process.on('exit', () => rmSync(work, { recursive: true, force: true }));

export const inWork = (name) => path.join(work, name);

/** The folder of real faces, or nothing. */
export const realFaces = process.env.SWEEPFACE_DATA;

export function run(program, ...args) {
  const result = spawnSync(program, args, { encoding: 'utf8', maxBuffer: 1 << 28 });
  if (result.error) throw result.error;
  if (result.status !== 0)
    throw new Error(`${[program, ...args].join(' ')}\n${result.stdout}${result.stderr}`);
  return result.stdout;
}

export const sweepface = (...args) => run(process.env.SWEEPFACE_TOOL, ...args);

let sample;
/** The project's sample face as a .sweep file, and its meshes. */
export function sampleFace() {
  if (sample) return sample;
  const folder = inWork('sample');
  run(process.env.SWEEPFACE_SAMPLE_MAKER, folder);
  sample = { sweep: path.join(folder, 'sample.sweep'), tolerance: 0.05, neutral: path.join(folder, 'neutral.obj'),
             expressions: path.join(folder, 'expressions') };
  return sample;
}

/** The vertices of an OBJ file, one after another. */
export function objPositions(file) {
  const numbers = [];
  for (const line of readFileSync(file, 'utf8').split('\n'))
    if (line.startsWith('v ')) numbers.push(...line.split(' ').slice(1, 4).map(Number));
  return numbers;
}

/** The JSON of a GLB file. */
export function glbJson(file) {
  const bytes = readFileSync(file);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString('utf8'));
}

export const targetNames = (file) =>
  glbJson(file).meshes.flatMap((mesh) => mesh.extras?.targetNames ?? []);
