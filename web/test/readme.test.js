// What README.md shows of three.js, run as it stands there in a page that has a scene, a camera and a renderer.
import assert from 'node:assert/strict';
import {existsSync, readFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {extname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';
import {sample} from './native.js';

const folder = fileURLToPath(new URL('..', import.meta.url));
const executablePath = process.env.SWEEPFACE_CHROMIUM ?? '/usr/bin/chromium';
const {chromium} = await import('playwright-core').catch(() => ({}));
const skip = !chromium ? 'playwright-core is not installed; try npm ci' : !existsSync(executablePath) ? `there is no ${executablePath}` : false;

const shown = readFileSync(join(folder, '../README.md'), 'utf8').match(/```js\n([^`]*sweepface\/three[^`]*)```/)[1].trim();
const [imported, ...rest] = shown.split('\n');
const page = `<!doctype html><link rel="icon" href="data:,"><script type="importmap">
{"imports": {"three": "./node_modules/three/build/three.module.js", "sweepface/three": "./sweepface_three.js"}}</script>
<script type="module">
import {HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer} from 'three';
${imported}
const scene = new Scene(), camera = new PerspectiveCamera(30, 1, 0.01, 1000), renderer = new WebGLRenderer();
scene.add(new HemisphereLight());
document.body.append(renderer.domElement);
${rest.join('\n')}
globalThis.shown = {face, renderer};
</script>`;

const types = {'.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html'};
function answer(request, response) {
  const {pathname} = new URL(request.url, 'http://localhost');
  const path = pathname === '/face.sweep' ? sample : join(folder, pathname);
  response.setHeader('content-type', types[extname(pathname)] ?? 'application/octet-stream');
  if (pathname === '/newcomer.html') return response.end(page);
  if (!existsSync(path)) return response.writeHead(404).end();
  response.end(readFileSync(path));
}

test('ten lines of the README show a face in three.js', {skip, timeout: 120_000}, async () => {
  assert.ok(rest.filter((line) => line.trim()).length + 1 <= 10);
  const server = createServer(answer);
  await new Promise((ready) => server.listen(0, 'localhost', ready));
  const browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']});
  try {
    const visit = await browser.newPage(), complaints = [];
    visit.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
    visit.on('pageerror', (error) => complaints.push(error.message));
    await visit.goto(`http://localhost:${server.address().port}/newcomer.html`);
    await visit.waitForFunction(() => globalThis.shown?.face.face.weights.jawOpen > 0.6);
    assert.ok(await visit.evaluate(() => globalThis.shown.renderer.info.render.triangles) > 1000);
    assert.deepEqual(complaints, []);
  } finally {
    await browser.close();
    server.close();
  }
});
