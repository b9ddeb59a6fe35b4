// Runs README.md's three.js example as it stands in a page that has a scene, a camera and a renderer.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {blank, skip, withPage} from './browser.js';
import {sample} from './native.js';

const text = readFileSync(new URL('../../README.md', import.meta.url), 'utf8');
const shown = text.match(/```js\n([^`]*sweepface\/three[^`]*)```/)[1].trim();
const [imported, ...rest] = shown.split('\n');
const newcomer = `${blank}
<script type="module">
import {HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer} from 'three';
${imported}
const scene = new Scene(), camera = new PerspectiveCamera(30, 1, 0.01, 1000), renderer = new WebGLRenderer();
scene.add(new HemisphereLight());
document.body.append(renderer.domElement);
${rest.join('\n')}
globalThis.shown = {face, renderer};
</script>`;

test('ten lines of the README show a face in three.js', {skip, timeout: 120_000}, () => {
  assert.ok(rest.filter((line) => line.trim()).length + 1 <= 10);
  const files = {'newcomer.html': newcomer, 'face.sweep': readFileSync(sample)};
  return withPage('newcomer.html', {files}, async (page, complaints) => {
    await page.waitForFunction(() => globalThis.shown?.face.face.weights.jawOpen > 0.6);
    assert.ok(await page.evaluate(() => globalThis.shown.renderer.info.render.triangles) > 1000);
    assert.deepEqual(complaints, []);
  });
});
