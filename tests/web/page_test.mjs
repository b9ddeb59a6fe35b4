// The example page plays a face in a browser.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import test from 'node:test';
import { difference, pixels, withPage } from './browser.mjs';
import { inWork, sampleFace, sweepface, work } from './tool.mjs';

const later = !process.env.SWEEPFACE_LONG && 'runs in the long tests';

const example = fileURLToPath(new URL('../../examples/three', import.meta.url));

// Keeps a picture for inspection if SWEEPFACE_PICTURES names a folder.
function keep(name, png) {
  if (process.env.SWEEPFACE_PICTURES) writeFileSync(`${process.env.SWEEPFACE_PICTURES}/${name}.png`, png);
}

for (const [name, options] of Object.entries({ exact: [], quantized: ['--quantize', '--lod', '2'] }))
  test(`the example plays a face, ${name}`, { skip: name !== 'exact' && later }, async () => {
    sweepface('animate', sampleFace().sweep, '--to', 'jawOpen=1,browInnerUp=1', '--law', 'newton',
              '--seconds', '10', '-o', inWork(`${name}.glb`), '-q', ...options);
    await withPage([example, work], `?file=${name}.glb`, async (page, said) => {
      await page.waitForFunction('document.body.dataset.playing > 0 && document.body.dataset.playing % 10 < 3');
      const first = await page.screenshot();
      await page.waitForFunction('document.body.dataset.playing % 10 > 6 && document.body.dataset.playing % 10 < 9');
      const second = await page.screenshot();
      keep(`${name}-first`, first), keep(`${name}-second`, second);
      assert.deepEqual(said, []);
      const [a, b] = [first, second].map(pixels);
      const empty = { ...a, data: new Uint8Array(a.data.length).map((_, k) => a.data[k % a.channels]) };
      const face = difference(a, empty), moved = difference(a, b);
      assert.ok(face > 0.1 && face < 0.9, `the face fills ${face} of the picture`);
      assert.ok(moved > 0.002 && moved < face, `${moved} of the picture moved`);
    });
  });

test('the example says what is wrong with a file that is none', async () => {
  writeFileSync(inWork('broken.glb'), 'glTF');
  await withPage([example, work], '?file=broken.glb', async (page) => {
    await page.waitForFunction('document.querySelector("p").textContent');
    assert.match(await page.textContent('p'), /^broken\.glb cannot be shown: /);
  });
});
