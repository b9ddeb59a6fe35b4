import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, statSync} from 'node:fs';
import {basename} from 'node:path';
import test from 'node:test';
import {setFlagsFromString} from 'node:v8';
import {runInNewContext} from 'node:vm';
import {Sweepface} from '../sweepface.js';
import {twinOf} from '../sweepface_twin.js';
import {difference, everyFile, exported, packed, played, sample, someWeights, withArcs} from './native.js';

const load = (options, file = sample) => Sweepface.load(readFileSync(file), options);
function evaluate(face) {
  const positions = new Float32Array(3 * face.vertexCount), normals = new Float32Array(3 * face.vertexCount);
  face.evaluate(positions, normals);
  return {positions, normals};
}

// The module does the native library's operations in the same order and without contraction, including sine and
// exponential, so that results are the same bit for bit.
for (const file of everyFile())
  for (const lod of [0, 2])
    test(`${basename(file)} at lod ${lod} is what the native library plays`, async () => {
      const face = await load({lod}, file), weights = someWeights(face.names);
      face.setWeights(weights);
      const {positions, normals} = evaluate(face);
      const native = played(file, weights, lod), exact = exported(file, weights, lod);
      assert.equal(native.positions.length, 3 * face.pointCount);
      assert.deepEqual(difference(native.positions, positions), {most: 0, count: 0});
      assert.deepEqual(difference(native.normals, normals), {most: 0, count: 0});
      assert.ok(difference(exact.positions, positions).most <= native.error);
      face.dispose();
    });

test('weights are set by name, and others stay', async () => {
  const face = await load();
  face.setWeights({jawOpen: 0.7});
  face.setWeights({browInnerUp: 0.25});
  assert.equal(face.weights.jawOpen, 0.7);
  assert.equal(face.weights.browInnerUp, 0.25);
  assert.deepEqual(Object.keys(face.weights), face.names);
  face.reset();
  assert.ok(Object.values(face.weights).every((weight) => weight === 0));
});

test('what turns goes on arcs, if the file tells', async () => {
  const file = withArcs(), plain = await load({}, file), arcs = await load({arcs: true}, file);
  const combined = await load({combine: true}, file);
  assert.ok(plain.turnCount > 0);
  assert.equal((await load({arcs: true})).turnCount, 0);
  assert.deepEqual(arcs.names, plain.names);
  const weights = {jawOpen: 0.5};
  for (const [face, options] of [[plain, []], [arcs, ['--arcs', 'on']]]) {
    face.setWeights(weights);
    const exact = exported(file, weights, 0, options);
    assert.ok(difference(exact.positions, evaluate(face).positions).most <= 0.01);
  }
  assert.ok(difference(evaluate(plain).positions, evaluate(arcs).positions).most > 0.03);
  combined.setWeights(weights);
  assert.deepEqual(evaluate(combined), evaluate(plain));
  weights.jawOpen = 1;  // where both end alike
  plain.setWeights(weights);
  arcs.setWeights(weights);
  assert.ok(difference(evaluate(plain).positions, evaluate(arcs).positions).most < 1e-3);
});

test('the mesh is ready for a graphics card', async () => {
  const face = await load(), {triangles, texcoords, parts, vertexCount} = face;
  assert.ok(vertexCount > face.pointCount);  // the seam down the back
  assert.ok(triangles.every((vertex) => vertex < vertexCount));
  assert.equal(texcoords.length, 2 * vertexCount);
  assert.deepEqual(parts.map(({material}) => material).sort(),
                   ['eyebrow', 'gums', 'iris', 'lips', 'nostril', 'pupil', 'sclera', 'skin', 'teeth']);
  let end = 0;
  for (const {start, count} of parts) {
    assert.equal(start, end);
    end += count;
  }
  assert.equal(end, triangles.length);
  assert.equal(triangles.length, 3 * 2 * 8102);
});

test('what there is not is refused with the library\'s sentence, and nothing changes', async () => {
  const face = await load();
  assert.throws(() => face.setWeights({jawOpen: 1, jawOpn: 1}),
                {message: /^There is no target named 'jawOpn'; its targets are eyeBlinkLeft, .*\.$/});
  assert.throws(() => face.setWeights({jawOpen: 1, browInnerUp: 1e9}),
                {message: 'The weight of \'browInnerUp\' must lie within 1000000 of 0.'});
  assert.throws(() => face.setWeights({jawOpen: NaN}), {message: /'jawOpen' must be a finite number, not NaN/});
  assert.throws(() => face.moveTo({jawOpen: 1}, 'jump'), {message: /no drive 'jump'; there are cut, newton/});
  assert.throws(() => face.moveTo({jawOpen: 1}, {speed: 1}), {message: /has no 'speed'; it has kind, delay/});
  assert.throws(() => face.moveTo({jawOpen: 1}, {kind: 'newton', seconds: 0}), {message: /\.$/});
  for (const [drive, idle] of [[{seconds: 2}, 'seconds'], [{kind: 'cut', turn: 0.5}, 'turn'],
                               [{kind: 'newton', damping: 1}, 'damping']])
    assert.throws(() => face.moveTo({jawOpen: 1}, drive), {message: new RegExp(`has no use for '${idle}'; leave it out`)});
  assert.throws(() => face.evaluate(new Float32Array(6)), {message: /There must be room for \d+ vertices/});
  assert.throws(() => face.setWeights(), {message: /^Weights are given by name/});
  for (const jawOpen of [1e9, -1e9])
    assert.throws(() => face.moveTo({jawOpen}), {message: /'jawOpen' must lie within 1000000 of 0\.$/});
  for (const push of [1e8, -1e8, NaN, undefined, '3', true, [5]])
    assert.throws(() => face.push('jawOpen', push), {message: /push on 'jawOpen' must lie within 1000000 of 0/});
  for (const drag of [-1, NaN, Infinity, null, '8'])
    assert.throws(() => face.push('jawOpen', 1, drag), {name: 'RangeError', message: /drag on a push must be a finite number/});
  for (const seconds of [NaN, Infinity, undefined])
    assert.throws(() => face.advance(seconds), {message: /finite number of seconds/});
  assert.equal(face.weights.jawOpen, 0);
});

/** How a face moves from now on. */
function goesOn(face) {
  return Array.from({length: 5}, () => [face.advance(0.05), face.weights]);
}

test('a refused goal or drive leaves all as it moves', async () => {
  const regions = [{name: 'above', points: [[0, 8, 9]], whole: 5, over: 'space', mass: 100}];
  for (const options of [{}, {regions}]) {
    const faces = [await load(options), await load(options)], [face] = faces, goals = {jawOpen: 0.25, browInnerUp: 1e6};
    for (const each of faces) each.moveTo({jawOpen: 1, mouthSmileLeft: 0.5}, {kind: 'newton', seconds: 1, delay: 0.1});
    const tooSoon = {kind: 'newton', seconds: 1.4e-152}, finite = {name: 'RangeError', message: /needs finite numbers/};
    assert.throws(() => face.moveTo(goals, tooSoon), finite);
    assert.throws(() => face.moveTo({jawOpen: 0.25, mouthSmileLeft: 1}, {kind: 'accelerate-brake', seconds: 1e303}), finite);
    assert.throws(() => face.moveTo({jawOpen: 0.25}, {kind: 'spring', frequency: 2e147, damping: 2}), finite);
    for (const drive of [{delay: -1}, {frequency: 0}, {damping: -1}, {kind: 'bounce', restitution: 1},
                         {kind: 'newton', seconds: 0}, {kind: 'accelerate-brake', turn: 1}])
      for (const to of [goals, {}]) assert.throws(() => face.moveTo(to, drive), {name: 'RangeError', message: /\.$/});
    for (const number of ['3', null, NaN, true, [2]])
      for (const to of [goals, {}])
        assert.throws(() => face.moveTo(to, {frequency: number}),
                      {name: 'TypeError', message: /^The frequency of a drive must be a finite number, not /});
    assert.deepEqual(goesOn(face), goesOn(faces[1]));
  }
});

test('bytes that are no face are refused with the library\'s sentence', async () => {
  const bytes = readFileSync(sample);
  await assert.rejects(Sweepface.load(new TextEncoder().encode('GIF89a'), {name: 'face.sweep'}),
                       {message: 'face.sweep does not begin with SWEEPFC; check that it is a .sweep file.'});
  for (const [start, name] of [['glTF\x02', 'x.bin'], ['v 0 0 0', 'x.OBJ'], ['ply', 'x.ply']])
    await assert.rejects(Sweepface.load(new TextEncoder().encode(start), {name}),
                         {message: `${name} is a file of meshes, not a face; make one of it first: sweepface convert.`});
  for (const options of [undefined, {name: undefined}, {name: ''}])
    await assert.rejects(Sweepface.load(bytes.subarray(0, bytes.length / 2), options),
                         {message: /^The face, byte \d+: the file ends/});
  await assert.rejects(Sweepface.load('face.sweep'), {message: /needs the bytes of a .sweep file/});
  await assert.rejects(load({lod: 65}), {message: /must be 0 to 64, not 65/});
  await assert.rejects(load({lod: 0.5}), {message: /whole number/});
  for (let k = 0; k < bytes.length; k += 9973) {
    const damaged = Uint8Array.from(bytes);
    damaged[k] ^= 0x55;
    await assert.rejects(Sweepface.load(damaged), {message: /^The face.*\.$/});
  }
});

test('a server\'s page in place of a face is called one', async () => {
  for (const page of ['<!doctype html>\n<title>404</title>', '\n<HTML><body>'])
    await assert.rejects(Sweepface.load(Buffer.from(page), {name: 'a.sweep'}), {message: /^a\.sweep is a page of HTML, /});
});

test('a large file that is no face is refused in little memory', async () => {
  const before = process.memoryUsage().heapUsed;
  const refused = assert.rejects(Sweepface.load(new Uint8Array(3e7)), /does not begin with SWEEPFC/);
  await Promise.resolve();
  assert.ok(process.memoryUsage().heapUsed - before < 1e7);
  await refused;
});

test('weights move by springs and are interrupted without a jump', async () => {
  const face = await load();
  face.moveTo({jawOpen: 1}, {kind: 'spring', frequency: 2, damping: 0.3});
  const seen = [];
  for (let k = 0; k < 240; ++k) {
    if (k === 20) face.moveTo({jawOpen: 0.2});
    face.advance(1 / 120);
    seen.push(face.weights.jawOpen);
  }
  assert.ok(Math.max(...seen) > 0.8);
  assert.ok(Math.abs(seen.at(-1) - 0.2) < 1e-4);
  const steps = seen.slice(1).map((weight, k) => Math.abs(weight - seen[k]));
  assert.ok(Math.max(...steps) < 0.1);
});

test('a cut may wait', async () => {
  const face = await load();
  face.moveTo({jawOpen: 1}, {kind: 'cut', delay: 0.5});
  assert.deepEqual([0.4, 0.2].map((seconds) => (face.advance(seconds), face.weights.jawOpen)), [0, 1]);
});

test('a motion says when it is over', async () => {
  const face = await load();
  assert.equal(face.advance(0.1), false);
  face.moveTo({jawOpen: 1}, {kind: 'accelerate-brake', seconds: 0.5, delay: 0.3});
  assert.equal(face.advance(0.2), true);   // it waits
  assert.equal(face.weights.jawOpen, 0);
  assert.equal(face.advance(0.35), true);  // it is halfway
  assert.ok(Math.abs(face.weights.jawOpen - 0.5) < 1e-9);
  face.advance(0.3);
  assert.equal(face.advance(0.1), false);
  assert.equal(face.weights.jawOpen, 1);
});

test('a wrong clock neither ends a motion nor makes it longer', async () => {
  for (const wrong of [-60, 1e11]) {
    const face = await load();
    face.moveTo({jawOpen: 1}, {kind: 'accelerate-brake', seconds: 0.5});
    assert.equal(face.advance(wrong), true);
    assert.equal(face.weights.jawOpen, 0);
    face.advance(0.6);
    assert.equal(face.advance(0.1), false);
    assert.equal(face.weights.jawOpen, 1);
  }
});

test('a motion that has just begun goes on', async () => {
  for (const [drive, step, steps] of [[{kind: 'accelerate-brake', seconds: 2}, 0.1, 30], ['spring', 0.1, 80],
                                      [{kind: 'accelerate-brake', seconds: 90}, 1 / 144, 100 * 144]]) {
    const face = await load();
    face.moveTo({jawOpen: 0.2}, drive);
    for (const tiny of [0, 1e-9]) assert.equal(face.advance(tiny), true);
    let count = 0;
    while (count < steps && face.advance(step)) ++count;
    assert.ok(count > 10 && count < steps, `${count} steps`);
    assert.ok(Math.abs(face.weights.jawOpen - 0.2) < 1e-4, `${face.weights.jawOpen}`);
  }
});

test('a motion goes on where it turns back', async () => {
  for (const [drive, goal, frames] of [[{kind: 'bounce', seconds: 3, restitution: 0.6}, 0.03, 60],
                                       [{kind: 'bounce', seconds: 2, restitution: 0.95}, 0.1, 240],
                                       [{frequency: 0.1, damping: 0.05}, 0.1, 120]]) {
    const face = await load();
    face.moveTo({jawOpen: goal}, drive);
    let count = 0;
    while (count < 1000 * frames && face.advance(1 / frames)) ++count;
    assert.ok(count < 1000 * frames);
    assert.ok(Math.abs(face.weights.jawOpen - goal) < 1e-5, `${face.weights.jawOpen}`);
  }
});

test('heavy regions are waited for', async () => {
  const face = await load({regions: [{name: 'above', points: [[0, 8, 9]], whole: 5, mass: 100, delay: 1}]});
  face.moveTo({jawOpen: 1}, {kind: 'accelerate-brake', seconds: 0.5});
  for (const seconds of [1, 1e-9]) assert.equal(face.advance(seconds), true);
  let seconds = 1;
  for (; face.advance(0.01); seconds += 0.01);
  assert.ok(Math.abs(seconds - 6) < 0.05, `${seconds}`);
});

test('what is set, cut or pushed is no longer waited for', async () => {
  for (const stop of [(face) => face.setWeights({jawOpen: 0.5}), (face) => face.reset(),
                      (face) => face.moveTo({jawOpen: 0.5}, 'cut'), (face) => face.push('jawOpen', 0)]) {
    const face = await load();
    face.moveTo({jawOpen: 1}, {delay: 60});
    assert.equal(face.advance(0.1), true);
    stop(face);
    face.advance(0.1);
    assert.equal(face.advance(0.1), false);
  }
  const face = await load();
  face.moveTo({jawOpen: 1, browInnerUp: 1}, {kind: 'newton', delay: 10, seconds: 1});
  face.setWeights({jawOpen: 0});
  assert.equal(face.advance(0.1), true);
});

test('a weight that swings or is pushed out of its range stops at its end', async () => {
  const face = await load();
  face.moveTo({jawOpen: 1e6}, {frequency: 1, damping: 0});
  for (let k = 0; k < 20; ++k) face.advance(0.1);
  assert.ok(Math.abs(face.weights.jawOpen) <= 1e6);
  for (const way of [1, -1]) {
    face.setWeights({jawOpen: 0});
    for (let k = 0; k < 20; ++k) face.push('jawOpen', 1e6 * way, 0.1);
    face.advance(60);
    assert.equal(face.weights.jawOpen, 1e6 * way);
  }
});

test('setting a weight ends its motion, and its alone', async () => {
  const face = await load();
  face.moveTo({jawOpen: 1, browInnerUp: 1});
  face.advance(0.05);
  face.setWeights({jawOpen: 0.1});
  face.advance(0.5);
  assert.equal(face.weights.jawOpen, 0.1);
  assert.ok(face.weights.browInnerUp > 0.9);
});

test('a push moves a weight until drag stops it', async () => {
  const face = await load();
  for (const [velocity, drag, end] of [[2, 4, 0.5], [-2, 4, 0], [2, undefined, 0.25]]) {
    face.push('jawOpen', velocity, drag);
    for (const seconds of [0, 5]) assert.equal(face.advance(seconds), true);
    assert.ok(Math.abs(face.weights.jawOpen - end) < 1e-6);
    assert.equal(face.advance(1), false);
  }
});

test('what a face tells is the caller\'s to change', async () => {
  const face = await load();
  for (const key of ['names', 'triangles', 'texcoords', 'weightValues']) {
    const before = [...face[key]];
    face[key].fill(1);
    assert.deepEqual([...face[key]], before, key);
  }
});

test('faces that nobody disposed of are freed with what refers to them', async () => {
  setFlagsFromString('--expose-gc');
  const collect = runInNewContext('gc'), kept = await Sweepface.load(readFileSync(sample)), before = kept.memoryBytes;
  for (let round = 0; round < 20; ++round) {
    for (let k = 0; k < 20; ++k) kept.clone().setWeights({jawOpen: 1});
    collect();
    await new Promise((resolve) => setTimeout(resolve, 10));
  }
  assert.ok(kept.memoryBytes < before + 100 * 24 * kept.vertexCount, `${kept.memoryBytes - before} bytes more`);
  assert.equal(kept.weights.jawOpen, 0);
});

test('a face that was disposed of is not freed once more when it is collected', async () => {
  setFlagsFromString('--expose-gc');
  const collect = runInNewContext('gc'), kept = await load(), other = await load();
  for (let k = 0; k < 20; ++k) kept.clone().dispose();
  for (let k = 0; k < 3; ++k) {
    collect();
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  const made = Array.from({length: 5}, () => kept.clone());
  for (const face of [kept, other]) face.setWeights({jawOpen: 1});
  assert.deepEqual(evaluate(kept), evaluate(other));
  assert.ok(made.every((face) => face.weights.jawOpen === 0));
});

test('faces of one file share it and are disposed of one by one', async () => {
  const face = await load(), twin = face.clone();
  twin.setWeights({jawOpen: 1});
  assert.equal(face.weights.jawOpen, 0);
  const {positions} = evaluate(twin);
  face.dispose();
  face.dispose();
  assert.throws(() => face.evaluate(null), {message: 'The face was disposed of.'});
  assert.throws(() => face.names, {message: 'The face was disposed of.'});
  assert.deepEqual(evaluate(twin).positions, positions);
  twin.dispose();
  assert.throws(() => twin.clone(), {message: 'The face was disposed of.'});
});

test('memory does not grow by making and disposing of faces, nor by evaluating', async () => {
  const face = await load({lod: 1});
  const positions = new Float32Array(3 * face.vertexCount), tooMany = new Int16Array(1e5);
  assert.throws(() => face.shaderModes(tooMany), /^Error: There are \d+ modes, not 25000\.$/);
  face.clone().dispose();
  const before = face.memoryBytes;
  for (let k = 0; k < 200; ++k) {
    const twin = face.clone();
    twin.moveTo({jawOpen: 1});
    twin.evaluate(positions);
    assert.throws(() => face.shaderModes(tooMany));
    twin.dispose();
  }
  assert.equal(face.memoryBytes, before);
});

test('a face that needs more memory than there is is refused', async () => {
  await assert.rejects(load({lod: 60}), {message: /^There is not enough memory for the face\.$|too many vertices/});
});

test('where browsers have no room for one more file, that is said, and no other module is tried', async () => {
  const {instantiate} = WebAssembly;
  let tried = 0;
  WebAssembly.instantiate = async () => {
    ++tried;
    throw new RangeError('WebAssembly.instantiate(): Out of memory: Cannot allocate Wasm memory for new instance');
  };
  try {
    await assert.rejects(load({}, packed()), {
      message: 'There is not enough memory for the face; dispose of others, or clone() those of one file.'
    });
    assert.equal(tried, 1);
  } finally {
    WebAssembly.instantiate = instantiate;
  }
});

test('a face whose module ran out of memory says so from then on', async () => {
  const {instantiate} = WebAssembly, wasm = new URL('../sweepface.wasm', import.meta.url);
  let malloc;
  WebAssembly.instantiate = async (module) => {
    const instance = await instantiate(module);
    ({malloc} = instance.exports);
    return instance;
  };
  try {
    const face = await load({wasm}, packed()), twin = face.clone(), without = {message: /^There is not enough memory/};
    for (let size = 2 ** 30; size >= 8; size /= 2) while (malloc(size));
    assert.throws(() => face.clone(), without);
    assert.equal(face.names.length, 2);  // a refused request does not end the module
    assert.throws(() => face.setWeights({jawOpen: 1}), without);
    for (const use of [() => face.names, () => twin.evaluate(new Float32Array(3 * 1e5)), () => twin.clone()])
      assert.throws(use, without);
    for (const each of [face, twin]) each.dispose();
    assert.throws(() => face.names, {message: 'The face was disposed of.'});
  } finally {
    WebAssembly.instantiate = instantiate;
  }
});

test('bytes of another realm hold a face and a module', async () => {
  const foreign = runInNewContext('(all) => Uint8Array.from(all).buffer');
  const wasm = foreign(readFileSync(new URL('../sweepface_full.wasm', import.meta.url)));
  assert.equal((await Sweepface.load(foreign(readFileSync(sample)), {wasm})).names.length, 42);
});

test('the module may come from elsewhere', async () => {
  const url = new URL('../sweepface_full.wasm', import.meta.url), code = readFileSync(url);
  const view = new DataView(code.buffer, code.byteOffset, code.length);
  for (const wasm of [code, view, await WebAssembly.compile(code), url, {href: url.href}])
    assert.equal((await load({wasm})).names.length, 42);
  const foreign = runInNewContext('(code) => new WebAssembly.Module(code)')(code);
  assert.equal((await load({wasm: foreign})).names.length, 42);
});

test('what is no module is refused with a sentence', async () => {
  for (const wasm of ['./sweepface.wasm', '/sweepface.wasm', 5, {}, {href: 5}, Promise.resolve()])
    await assert.rejects(load({wasm}), {message: /^The option wasm is an absolute URL, bytes or a WebAssembly\.Module, not /});
  const empty = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);
  await assert.rejects(load({wasm: empty}), {message: /another module than those of sweepface\.$/});
  await assert.rejects(load({wasm: Uint8Array.of(1, 2, 3)}), {message: /^The option wasm holds no module of WebAssembly: /});
});

test('a relative URL of the module goes by the base of the page', async () => {
  const {fetch, document, location} = globalThis, asked = [];
  globalThis.fetch = async (url) => {
    asked.push(String(url));
    return new Response(readFileSync(new URL('../sweepface_full.wasm', import.meta.url)));
  };
  try {
    globalThis.location = {href: 'https://example.org/a/page.html'};  // in workers there is no document
    await load({wasm: 'm.wasm'});
    globalThis.document = {baseURI: 'https://example.org/b/'};
    await load({wasm: 'm.wasm'});
    assert.deepEqual(asked, ['https://example.org/a/m.wasm', 'https://example.org/b/m.wasm']);
    for (const wasm of [5, 0, '', false])
      await assert.rejects(load({wasm}), {name: 'TypeError', message: /^The option wasm is an absolute URL/});
  } finally {
    Object.assign(globalThis, {fetch, document, location});
  }
});

test('a packed face needs the usual module only, with all that is played', async () => {
  const file = packed(), wasm = new URL('../sweepface.wasm', import.meta.url);
  const face = await load({wasm}, file), full = await load({wasm: new URL('../sweepface_full.wasm', import.meta.url)}, file);
  assert.deepEqual(face.names, ['jawOpen', 'mouthSmileLeft']);
  assert.deepEqual(face.parts, full.parts);
  assert.deepEqual(face.triangles, full.triangles);
  assert.deepEqual(face.texcoords, full.texcoords);
  assert.ok(face.texcoords.length > 0);
  for (const each of [face, full]) each.moveTo({jawOpen: 0.5, mouthSmileLeft: 1}, {kind: 'bounce', seconds: 0.3});
  for (let k = 0; k < 20; ++k) {
    for (const each of [face, full]) each.advance(1 / 30);
    assert.deepEqual(evaluate(face), evaluate(full));
  }
  assert.deepEqual(face.shaderTables(true), full.shaderTables(true));
  await assert.rejects(load({wasm}), {message: /give sweepface_full.wasm, which can or says why\.$/});
  for (const options of [{eyes: true}, {arcs: true}, {combine: true}, {vertices: 500}, {edgeLength: 1}, {error: 1},
                         {regions: [{name: 'a', parts: ['lips']}]}])
    await assert.rejects(load({wasm, ...options}, file), {message: /give sweepface_full.wasm/});
});

test('a packed face has eyes, combinations, arcs and regions, too', async () => {
  const regions = [{name: 'above', points: [[0, 8, 9]], over: 'space', whole: 5}];
  for (const key of ['eyes', 'combine', 'arcs']) {
    const face = await load({[key]: true, regions}, packed());
    assert.deepEqual([face.eyeCount, face.regions], [key === 'eyes' ? 2 : 0, ['rest', 'above']]);
  }
});

test('a spring without a damper never rests', async () => {
  const face = await Sweepface.load(readFileSync(sample));
  face.moveTo({jawOpen: 1}, {frequency: 2, damping: 0});
  for (let k = 0; k < 9; ++k) assert.equal(face.advance(0.5), true);
});

test('modes are read where the face has not moved yet', async () => {
  const bytes = readFileSync(packed()), {modes} = (await Sweepface.load(bytes)).shaderTables();
  const fresh = await Sweepface.load(bytes);
  assert.ok(fresh.shaderModes(new Int16Array(4 * modes)) > 0);
  assert.throws(() => fresh.shaderModes(new Int16Array(4 * modes + 3)), {name: 'RangeError', message: /four numbers each/});
});

test('options are those that there are, and one level of detail', async () => {
  const bytes = readFileSync(sample);
  for (const lod of [-1, 0.5, 2 ** 32 + 2])
    await assert.rejects(Sweepface.load(bytes, {lod}), {name: 'RangeError', message: /from 0 to 64/});
  await assert.rejects(load({lods: 2}), {message: /^Sweepface.load has no option 'lods'; it has lod, .*\.$/});
  await assert.rejects(load({lod: 2, vertices: 500}), {message: /in one way, not by lod and vertices\.$/});
  await assert.rejects(load({vertices: '500'}), {message: /must be a number, not the text '500'\.$/});
  for (const key of ['arcs', 'combine', 'eyes'])
    await assert.rejects(load({[key]: 'off'}),
                         {name: 'TypeError', message: `The option '${key}' is true or false, not the text 'off'.`});
  await assert.rejects(load({error: null}), {message: /must be a number, not null\.$/});
  const keys = ['lod', 'edgeLength', 'error', 'vertices', 'arcs', 'combine', 'eyes', 'regions', 'wasm'];
  const nothing = Object.fromEntries(keys.map((key) => [key]));
  const face = await load(nothing, packed());
  face.moveTo({jawOpen: 1}, {kind: 'cut', delay: undefined, seconds: undefined});
  face.advance(0);
  assert.equal(face.weights.jawOpen, 1);
  face.moveTo({jawOpen: 0.5}, null);
});

test('a level of detail goes by the budget that is given', async () => {
  const faces = await Promise.all([{edgeLength: 1}, {error: 1}, {vertices: 3000}].map((budget) => load(budget)));
  const [short, near, few] = faces.map(({pointCount}) => pointCount);
  assert.ok(short > 2 * near, `${short}, ${near}`);
  assert.ok(few > 2500 && few <= 3000, `${few}`);
});

test('browsers that make no instance of a large module at once can load a face', async () => {
  const {Instance} = WebAssembly;
  WebAssembly.Instance = () => { throw new RangeError('WebAssembly.Instance is disallowed on the main thread'); };
  try {
    assert.equal((await load()).names.length, 42);
  } finally {
    WebAssembly.Instance = Instance;
  }
});

test('a file is the caller\'s again at once', async () => {
  const mine = Uint8Array.from(readFileSync(sample)), sent = Uint8Array.from(mine);
  const both = [load({}), Sweepface.load(mine), Sweepface.load(sent)];
  mine.fill(0);
  structuredClone(sent.buffer, {transfer: [sent.buffer]});
  for (const face of await Promise.all(both)) assert.equal(face.names.length, 42);
  for (const gone of [sent, sent.buffer])
    for (const refused of [Sweepface.load(gone), Sweepface.load(readFileSync(sample), {wasm: gone})])
      await assert.rejects(refused, {name: 'TypeError', message: /^The bytes were sent away with their buffer; /});
});

test('no options are given as nothing, too', async () => {
  assert.equal((await load(null)).lod, 0);
});

test('arrays that cannot hold what is written are refused', async () => {
  const face = await load(), count = 3 * face.vertexCount, {modes} = face.shaderTables();
  const doubles = new Float64Array(count), floats = new Float32Array(count);
  face.evaluate(doubles);
  face.evaluate(floats);
  assert.deepEqual(Float32Array.from(doubles), floats);
  face.evaluate(null, floats);
  assert.deepEqual(floats, evaluate(face).normals);
  for (const out of [new Int16Array(count), new Array(count).fill(0), new ArrayBuffer(4 * count), 'x'.repeat(count), 5])
    for (const write of [() => face.evaluate(out), () => face.evaluate(null, out)])
      assert.throws(write, {name: 'TypeError', message: /written to a Float32Array, a Float64Array or null, not to (\w+)\.$/});
  for (const out of [undefined, null, new Uint8Array(4 * modes), new Array(4 * modes).fill(0)])
    assert.throws(() => face.shaderModes(out), {name: 'TypeError', message: /written to an Int16Array/});
});

test('positions and normals are not written over each other', async () => {
  const face = await load(), count = 3 * face.vertexCount, both = new Float32Array(2 * count);
  const shared = [both, new Float32Array(both.buffer, 4 * count - 4, count), new Float64Array(both.buffer, 0, count)];
  for (const normals of shared)
    for (const write of [() => face.evaluate(both, normals), () => face.evaluate(normals, both)])
      assert.throws(write, {name: 'RangeError', message: /to different places\.$/});
  face.evaluate(both, both.subarray(count));
  const {positions, normals} = evaluate(face);
  assert.deepEqual(both, Float32Array.of(...positions, ...normals));
});

test('weights and drives of another shape are refused, not passed over', async () => {
  const face = await load();
  for (const weights of [new Map([['jawOpen', 1]]), [], [0.5], new Set()])
    assert.throws(() => face.setWeights(weights), {name: 'TypeError', message: /^Weights are given by name/});
  for (const drive of [0.5, true, [], ['spring']])
    assert.throws(() => face.moveTo({jawOpen: 1}, drive), {name: 'TypeError', message: /^A drive is a name, or numbers/});
  for (const [weight, told] of [['0.5', 'the text \'0.5\''], [1n, '1n'], [Object.create(null), 'Object'], [[], 'Array']])
    assert.throws(() => face.setWeights({jawOpen: weight}), ({message}) => message.endsWith(`a finite number, not ${told}.`));
  assert.throws(() => face.advance('0.5'), {message: /seconds, not the text '0\.5'\.$/});
});

test('shared memory may hold a file', async () => {
  const {decode} = TextDecoder.prototype, bytes = readFileSync(sample);
  const shared = new Uint8Array(new SharedArrayBuffer(bytes.length));
  shared.set(bytes);
  TextDecoder.prototype.decode = function(source) {  // as browsers do
    if (source?.buffer instanceof SharedArrayBuffer) throw new TypeError('It must not be shared.');
    return decode.apply(this, arguments);
  };
  try {
    assert.equal((await Sweepface.load(shared)).names.length, 42);
  } finally {
    TextDecoder.prototype.decode = decode;
  }
});

test('memory may lie beyond 2 GiB', async () => {
  const {instantiate} = WebAssembly, usual = await load({eyes: true});
  WebAssembly.instantiate = async (module) => {
    const {exports} = await instantiate(module);
    exports._initialize();
    for (let k = 0; k < 2; ++k) exports.malloc(2 ** 30);
    return {exports: {...exports, _initialize() {}}};
  };
  try {
    const face = await load({eyes: true});
    assert.ok(face.memoryBytes > 2 ** 31);
    for (const each of [face, usual]) each.setWeights({jawOpen: 0.5});
    assert.deepEqual(evaluate(face), evaluate(usual));
    assert.deepEqual(face.triangles, usual.triangles);
    face.moveTo({jawOpen: 1});
    assert.equal(face.advance(0.1), true);
    assert.throws(() => face.setWeights({jawOpn: 1}), /its targets are/);
    assert.ok(face.shaderTables().places.length > 0);
  } finally {
    WebAssembly.instantiate = instantiate;
  }
});

test('a module is compiled while it comes only if the server calls it by its very name', async () => {
  const {fetch} = globalThis, code = readFileSync(new URL('../sweepface_full.wasm', import.meta.url));
  const served = (type, bytes = code) => {
    globalThis.fetch = async () => new Response(bytes, {headers: {'content-type': type}});
    return load({wasm: 'https://example.org/a.wasm'});
  };
  try {
    for (const type of ['application/wasm', 'Application/WASM', 'application/wasm; charset=utf-8', 'text/plain', 'text/html'])
      assert.equal((await served(type)).names.length, 42);
    await assert.rejects(served('text/html; charset=utf-8', '<!doctype html>'), {
      message: 'Could not load https://example.org/a.wasm: the server sent a page of HTML instead.'
    });
    globalThis.fetch = async () => new Response('', {headers: {'content-type': 'application/wasm'}});
    await assert.rejects(load({wasm: 'https://example.org/a.wasm'}), /^Error: Could not load https:\/\/example\.org\/a\.wasm: /);
    globalThis.fetch = async () => new Response(code, {status: 404});
    await assert.rejects(load({wasm: 'https://example.org/a.wasm'}), /a\.wasm: the server answered 404\.$/);
  } finally {
    globalThis.fetch = fetch;
  }
});

function crc32(...parts) {
  let c = 0xffffffff;
  for (const byte of Buffer.concat(parts)) {
    c ^= byte;
    for (let bit = 0; bit < 8; ++bit) c = (c & 1 ? 0xedb88320 : 0) ^ (c >>> 1);
  }
  return ~c >>> 0;
}

/** A packed face whose targets are nonsense, with a checksum that matches. */
function withoutMoves() {
  const bytes = Buffer.from(readFileSync(packed())), at = bytes.indexOf('MOVE'), begin = at + 12;
  const payload = bytes.subarray(begin, begin + bytes.readUInt32LE(at + 4));
  payload.fill(0x5a);
  bytes.writeUInt32LE(crc32(bytes.subarray(at, at + 4), payload), at + 8);
  return bytes;
}

test('a packed face shows its neutral before it reads what targets do', async () => {
  const face = await Sweepface.load(withoutMoves()), whole = await load({}, packed());
  assert.deepEqual(face.names, whole.names);
  assert.deepEqual(evaluate(face), evaluate(whole));
  for (const move of [() => face.setWeights({jawOpen: 1}), () => face.moveTo({jawOpen: 1}), () => face.prepare(),
                      () => face.push('jawOpen', 1), () => face.shaderTables()])
    for (let twice = 0; twice < 2; ++twice) assert.throws(move, /^Error: The face: what its targets do cannot be read; convert/);
  assert.equal(face.advance(0.1), false);
  face.setWeights({});
  for (const each of [face, twinOf(face)]) assert.deepEqual(evaluate(each), evaluate(whole));
  face.dispose();
});

test('the full module says what is wrong with targets that cannot be read', async () => {
  const face = await Sweepface.load(withoutMoves(), {wasm: new URL('../sweepface_full.wasm', import.meta.url)});
  assert.throws(() => face.setWeights({jawOpen: 1}), /^Error: The face, chunk 'MOVE', byte \d+: .*convert/);
  face.dispose();
});

/** The sizes of the modules that each of `loads` fetches, and what it throws; in a process of their own. */
function fetched(...loads) {
  const script = `
    import {readFileSync} from 'node:fs';
    import {Sweepface} from ${JSON.stringify(new URL('../sweepface.js', import.meta.url))};
    const {compile} = WebAssembly, told = [];
    for (const [file, length, options, fault] of ${JSON.stringify(loads)}) {
      told.push([]);
      WebAssembly.compile = async (code) => {
        if (fault) throw new Error(fault);
        told.at(-1).push(code.length);
        return compile(code);
      };
      await Sweepface.load(readFileSync(file).subarray(0, length), options).catch(({message}) => told.at(-1).push(message));
    }
    console.log(JSON.stringify(told));`;
  return JSON.parse(execFileSync(process.execPath, ['--input-type=module', '-e', script], {encoding: 'utf8'}));
}

test('the full module is fetched where it is needed, and by itself where that is known before', async () => {
  const file = packed(), {size} = statSync(file), [usual, full] = ['sweepface.wasm', 'sweepface_full.wasm'].map(
      (name) => statSync(new URL(`../${name}`, import.meta.url)).size);
  const [[message], again] = fetched([file, size, {}, 'Cut.'], [file]);
  assert.match(message, /^Could not load .*sweepface\.wasm: Cut\.$/);
  assert.deepEqual(again, [usual]);
  const [first, half] = fetched([file], [file, size - 1, {name: 'Half'}]);
  assert.deepEqual([first, half.slice(0, 1)], [[usual], [full]]);
  assert.match(half[1], /^Half, byte \d+: the file ends/);
  assert.deepEqual(fetched([sample], [file, size, {vertices: 5000}]), [[full], []]);
});
