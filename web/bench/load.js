// How long a browser takes from the bytes of a face and of the module to its first frame: every visit is a new browser
// without anything in its caches, so that code runs for the first time.
//
//   npm ci && node bench/load.js FACE.sweep [VISITS]
import {existsSync, readFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {extname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {chromium} from 'playwright-core';

const [file, visits = 7] = process.argv.slice(2);
if (!file) {
  console.error('Usage: node bench/load.js FACE.sweep [VISITS]');
  process.exit(2);
}
const folder = fileURLToPath(new URL('..', import.meta.url));
const executablePath = process.env.SWEEPFACE_CHROMIUM ?? '/usr/bin/chromium';
const types = {'.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm'};
const page = `<!doctype html><script type="importmap">
  {"imports": {"three": "./node_modules/three/build/three.module.js"}}</script>`;

const server = createServer((request, response) => {
  const {pathname} = new URL(request.url, 'http://localhost');
  const path = pathname === '/face' ? file : join(folder, pathname);
  response.setHeader('content-type', types[extname(pathname)] ?? 'application/octet-stream');
  if (pathname === '/load.html') return response.end(page);
  if (!existsSync(path)) return response.writeHead(404).end();
  response.end(readFileSync(path));
});
await new Promise((ready) => server.listen(0, 'localhost', ready));

/** Runs in the page: milliseconds of each step. */
async function measure() {
  const {Sweepface} = await import('/sweepface.js'), {SweepfaceMesh} = await import('/sweepface_three.js');
  const bytesOf = async (url) => (await fetch(url)).arrayBuffer();
  const code = await bytesOf('/sweepface.wasm'), bytes = await bytesOf('/face');
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

const all = {};
for (let k = 0; k < Number(visits); ++k) {
  const browser = await chromium.launch({executablePath, args: ['--no-sandbox']});
  const visit = await browser.newPage();
  await visit.goto(`http://localhost:${server.address().port}/load.html`);
  const steps = await visit.evaluate(measure);
  for (const [step, time] of Object.entries(steps)) (all[step] ??= []).push(time);
  await browser.close();
}
server.close();

console.log(`milliseconds, medians of ${visits} visits (and the least)`);
for (const [step, times] of Object.entries(all)) {
  times.sort((a, b) => a - b);
  console.log(`${step.padEnd(14)} ${times[times.length >> 1].toFixed(1).padStart(7)} (${times[0].toFixed(1)})`);
}
