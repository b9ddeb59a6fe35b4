import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';
import {loadInWorker} from '../sweepface_worker.js';
import {skip, withPage} from './browser.js';
import {packed, sample} from './native.js';
import {converted, model} from './scene_file.js';

const options = {skip, timeout: 240_000};

/** A page with the functions of the package, and `digest`, which tells what a face is and shows in an expression. */
const blank = `<!doctype html><link rel="icon" href="data:,">
  <script type="importmap">{"imports": {
    "three": "./node_modules/three/build/three.module.js", "three/addons/": "./node_modules/three/examples/jsm/"}}</script>
  <script type="module">
    import {Sweepface} from './sweepface.js';
    import {loadInWorker} from './sweepface_worker.js';
    import {SweepfaceSceneLoader} from './sweepface_scene.js';
    import {SweepfaceLoader} from './sweepface_three.js';
    async function digest(face) {
      face.setWeights({jawOpen: 0.7});
      const positions = new Float32Array(3 * face.vertexCount), normals = positions.slice();
      face.evaluate(positions, normals);
      const {names, lod, tolerance, turnCount, pointCount, regions, eyeCount, weights} = face;
      const arrays = [positions, normals, face.triangles, face.texcoords ?? new Float32Array(), face.copies];
      const sums = await Promise.all(arrays.map(async ({buffer}) => {
        return String(new Uint8Array(await crypto.subtle.digest('SHA-256', buffer)));
      }));
      return {names, lod, tolerance, turnCount, pointCount, regions, eyeCount, weights, parts: face.parts, sums};
    }
    const bytesOf = async (name) => (await fetch(name)).arrayBuffer();
    Object.assign(globalThis, {Sweepface, loadInWorker, SweepfaceLoader, SweepfaceSceneLoader, digest, bytesOf});
  </script>`;

const files = () => ({
  'blank.html': blank, 'sample.sweep': readFileSync(sample), 'packed.sweep': readFileSync(packed()),
  'model.sweep': readFileSync(converted(model())), 'broken.sweep': readFileSync(packed()).subarray(0, 2000)
});

const visit = (more, use) => withPage('blank.html', {files: {...files(), ...more}}, async (page, complaints) => {
  await page.waitForFunction(() => globalThis.bytesOf);
  return use(page, complaints);
});

test('a worker loads what Sweepface.load loads, and says what that says', options, () => visit({}, async (page, complaints) => {
  const regions = [{name: 'chin', points: [[0, -8, 8]], whole: 3, fade: 4, mass: 2}];
  for (const [name, settings] of [['packed.sweep', {}], ['packed.sweep', {lod: 2}], ['packed.sweep', {regions}],
                                  ['sample.sweep', {eyes: true}], ['packed.sweep', {vertices: 3000}],
                                  ['packed.sweep', {wasm: 'sweepface_full.wasm'}], ['model.sweep', {}]]) {
    const [mine, usual] = await page.evaluate(async ([name, settings]) => {
      const {bytesOf, digest, loadInWorker, Sweepface} = globalThis, bytes = await bytesOf(name);
      const face = await loadInWorker(bytes, settings);
      return [await digest(face), await digest(await Sweepface.load(bytes, settings)), await digest(face.clone())];
    }, [name, settings]);
    assert.deepEqual(mine, usual, `${name} ${JSON.stringify(settings)}`);
  }
  for (const [name, settings] of [['broken.sweep', {name: 'broken.sweep'}], ['packed.sweep', {lod: -1}],
                                  ['packed.sweep', {light: 1}], ['packed.sweep', {wasm: 'nowhere.wasm'}], ['blank.html', {}],
                                  ['packed.sweep', {regions: [{name: 'chin', curves: ['nose']}]}]]) {
    const [mine, usual] = await page.evaluate(async ([name, settings]) => {
      const {bytesOf, loadInWorker, Sweepface} = globalThis, bytes = await bytesOf(name);
      const told = (error) => error.message;
      return [await loadInWorker(bytes, settings).catch(told), await Sweepface.load(bytes, settings).catch(told)];
    }, [name, settings]);
    assert.equal(typeof mine, 'string');
    assert.equal(mine, usual);
  }
  assert.equal(page.workers().length, 1);  // for all of them
  assert.equal(complaints.filter((text) => !text.includes('404')).length, 0);
}));

test('several faces load at once, and each follows its own weights', options, () => visit({}, async (page) => {
  const [weights, moved] = await page.evaluate(async () => {
    const {bytesOf, loadInWorker} = globalThis, bytes = await bytesOf('packed.sweep');
    const faces = await Promise.all([0, 1, 2].map(() => loadInWorker(bytes)));
    faces.forEach((face, k) => face.moveTo({jawOpen: k / 2}, {kind: 'linear-force', seconds: 0.1}));
    faces.forEach((face) => face.advance(1));
    const positions = faces.map((face) => new Float32Array(3 * face.vertexCount));
    faces.forEach((face, k) => face.evaluate(positions[k]));
    return [faces.map((face) => face.weights.jawOpen), positions.map((list) => list.some((x, k) => x !== positions[0][k]))];
  });
  assert.deepEqual([weights, moved], [[0, 0.5, 1], [false, true, true]]);
}));

test('loaders of three.js load in a worker', options, () => visit({}, async (page, complaints) => {
  assert.deepEqual(await page.evaluate(async () => {
    const {loadInWorker: load, SweepfaceLoader, SweepfaceSceneLoader} = globalThis;
    const mesh = await new SweepfaceLoader(undefined, {load}).loadAsync('packed.sweep');
    const {face} = await new SweepfaceSceneLoader(undefined, {load}).loadAsync('model.sweep');
    return [mesh.names.length, face.names.length];
  }), [2, 3]);
  assert.equal(page.workers().length, 1);
  assert.deepEqual(complaints, []);
}));

test('a worker ends when it has had no work for a while', options, () => visit({}, async (page) => {
  await page.clock.install();
  const load = () => page.evaluate(async () => {
    return (await globalThis.loadInWorker(await globalThis.bytesOf('packed.sweep'))).names.length;
  });
  assert.equal(await load(), 2);
  await page.clock.runFor(9_000);
  assert.equal(await load(), 2);
  await page.clock.runFor(9_000);
  assert.equal(page.workers().length, 1);
  await page.clock.runFor(2_000);
  for (let tries = 0; page.workers().length > 0 && tries < 100; ++tries)
    await new Promise((done) => { setTimeout(done, 50); });
  assert.equal(page.workers().length, 0);
  assert.equal(await load(), 2);  // in a new one
}));

test('a worker that does not start says so, once and again', options, () => visit({
  'sweepface_thread.js': (response) => response.writeHead(404).end()
}, async (page) => {
  for (let twice = 0; twice < 2; ++twice)
    assert.match(await page.evaluate(async () => {
      return globalThis.loadInWorker(await globalThis.bytesOf('packed.sweep')).catch(({message}) => message);
    }), /^The worker that loads faces did not start/);
}));

const failing = `addEventListener('message', ({data: {number}}) => {
  if (number > 1) throw new Error('Out of luck');
  postMessage({number, error: 'No face.'});
});`;

test('a worker that fails later says that, and the next load starts another', options, () => visit({
  'sweepface_thread.js': (response) => response.setHeader('content-type', 'text/javascript').end(failing)
}, async (page) => {
  const told = await page.evaluate(async () => {
    const messages = [];
    for (let load = 0; load < 3; ++load)
      await globalThis.loadInWorker(await globalThis.bytesOf('packed.sweep')).catch(({message}) => messages.push(message));
    return messages;
  });
  assert.equal(told[0], 'No face.');
  for (const message of [told[1], told[2]]) assert.match(message, /^The worker that loads faces (failed|did not start): .*Out of luck/);
  assert.match(told[1], /faces failed/);
}));

test('where there are no workers it says so', async () => {
  await assert.rejects(loadInWorker(readFileSync(sample)), {message: 'There are no workers here; use Sweepface.load.'});
  await assert.rejects(loadInWorker('face.sweep'), {name: 'TypeError', message: /^Sweepface\.load needs the bytes/});
});
