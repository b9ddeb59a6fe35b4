// Measures how long a browser takes from the bytes of a face and of the module to the first frame. Every visit is a new
// browser with empty caches, so that code runs for the first time.
//
//   npm ci && node bench/load.js FACE.sweep [VISITS [sweepface_full.wasm]]
//
// A face that is not packed needs the full module.
import {readFileSync} from 'node:fs';
import {blank, withPage} from '../test/browser.js';

const [file, visits = 7, module = 'sweepface.wasm'] = process.argv.slice(2);
if (!file) {
  console.error('Usage: node bench/load.js FACE.sweep [VISITS [sweepface_full.wasm]]');
  process.exit(2);
}
const files = {'blank.html': blank, 'face.sweep': readFileSync(file)};

/** Runs in the page. Returns the milliseconds of each step. */
async function measure(module) {
  const {Sweepface} = await import('/sweepface.js'), {SweepfaceMesh} = await import('/sweepface_three.js');
  const bytesOf = async (url) => (await fetch(url)).arrayBuffer();
  const code = await bytesOf(`/${module}`), bytes = await bytesOf('/face.sweep');
  const steps = {};
  let before = performance.now();
  const done = (step) => {
    const now = performance.now();
    steps[step] = now - before;
    before = now;
  };
  const wasm = await WebAssembly.compile(code);
  done('compile');
  const face = await Sweepface.load(bytes, {wasm});
  done('decode');
  const mesh = new SweepfaceMesh(face);
  mesh.update(0);
  done('first frame');
  face.prepare();
  done('ready to move');
  face.setWeights({[face.names[0]]: 1});
  mesh.update(0);
  done('first move');
  return steps;
}

/** The same in a worker: until the face is ready to move, and the longest that the page stands still meanwhile. */
async function measureWorker(module) {
  const {loadInWorker} = await import('/sweepface_worker.js');
  const bytes = await (await fetch('/face.sweep')).arrayBuffer(), tick = () => new Promise((done) => { setTimeout(done); });
  const began = performance.now();
  let last = began, longest = 0, ready;
  loadInWorker(bytes, {wasm: `/${module}`}).then(() => { ready = performance.now() - began; });
  while (!ready) {
    await tick();
    const now = performance.now();
    longest = Math.max(longest, now - last);
    last = now;
  }
  return {'in a worker': ready, 'page stalls': longest};
}

const all = {};
for (let k = 0; k < Number(visits); ++k)
  for (const each of [measure, measureWorker]) {
    const steps = await withPage('blank.html', {files}, (page) => page.evaluate(each, module));
    for (const [step, time] of Object.entries(steps)) (all[step] ??= []).push(time);
  }

console.log(`milliseconds, medians of ${visits} visits (and the least)`);
for (const [step, times] of Object.entries(all)) {
  times.sort((a, b) => a - b);
  console.log(`${step.padEnd(14)} ${times[times.length >> 1].toFixed(1).padStart(7)} (${times[0].toFixed(1)})`);
}
