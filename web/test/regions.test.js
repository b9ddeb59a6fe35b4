import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {readTimeline, TimelinePlayer} from '../sweepface_clips.js';
import {Sweepface} from '../sweepface.js';
import {difference, newFolder, positionsOf, readObj, sample, someWeights, tool} from './native.js';

const bytes = readFileSync(sample);
const load = (regions, options = {}) => Sweepface.load(bytes, {...options, regions});

/** The upper half of the sample face, heavier and later than the rest. */
const above = {name: 'above', points: [[0, 8, 9]], over: 'space', whole: 5, fade: 4, mass: 4, delay: 0.1};

test('a face of one piece has no regions', async () => {
  const face = await Sweepface.load(bytes);
  assert.deepEqual(face.regions, []);
  assert.throws(() => face.moveTo({jawOpen: 1}, 'spring', 'above'), /no region named 'above'; there are none/);
  assert.throws(() => face.setWeights({}, 'above'), /no region named 'above'; there are none/);
});

test('regions that agree are the plain face', async () => {
  const face = await load([above]), plain = await Sweepface.load(bytes), weights = someWeights(face.names);
  assert.deepEqual(face.regions, ['rest', 'above']);
  face.setWeights(weights);
  plain.setWeights(weights);
  assert.ok(difference(positionsOf(face), positionsOf(plain)).most <= 3 * face.tolerance);
  assert.deepEqual(face.weightsIn('above'), plain.weights);
});

test('a weight of one region moves nothing outside it', async () => {
  const face = await load([{name: 'mouth', parts: ['lips'], fade: 1}]), rest = positionsOf(face);
  face.setWeights({jawOpen: 1}, 'mouth');
  assert.equal(face.weights.jawOpen, 0);
  assert.equal(face.weightsIn('mouth').jawOpen, 1);
  assert.deepEqual([...face.weightValues], face.names.map((name) => face.weights[name]));
  const inside = difference(positionsOf(face), rest);
  face.setWeights({jawOpen: 1});
  const whole = difference(positionsOf(face), rest);
  assert.ok(inside.count > 300);
  assert.ok(inside.count < whole.count / 2, `${inside.count} of ${whole.count} numbers`);
});

// The tool moves the same regions in double precision.
const wave = {name: 'wave', points: [[0, 8, 9]], fade: 16, over: 'space', bands: 4, delay: 0.3};
const drawn = {name: 'drawn', line: [[0, -5, 9], [0, 0, 9]], curves: ['face 0.0 - left face 0.1'],
               nodes: {'left face 0.2': 0.5}, fade: 3, stiffness: 4};
for (const [title, regions] of [['a painted region', [above]], ['bands', [wave]], ['what is drawn', [drawn]]])
  test(`${title} moves as the tool moves it`, async () => {
    const folder = newFolder(), file = join(folder, 'regions.json');
    writeFileSync(file, JSON.stringify({regions}));
    execFileSync(tool, ['animate', sample, '--to', 'jawOpen=1,browInnerUp=1', '--law', 'spring',
                        '--frequency', '2', '--damping', '0.5', '--seconds', '1', '--fps', '10',
                        '--regions', file, '-o', folder, '--quiet']);
    const face = await load(regions);
    face.moveTo({jawOpen: 1, browInnerUp: 1}, {kind: 'spring', frequency: 2, damping: 0.5});
    const frames = readdirSync(folder).filter((name) => name.endsWith('.obj')).sort();
    assert.ok(frames.length >= 10);
    for (const frame of frames) {
      const exact = readObj(join(folder, frame)).positions;
      assert.ok(difference(exact, positionsOf(face)).most <= face.tolerance, frame);
      face.advance(0.1);
    }
    assert.notEqual(face.weightsIn(face.regions.at(-1)).jawOpen, face.weights.jawOpen);
    face.setWeights({jawOpen: 0.25});  // at once, however late a region is
    face.advance(0.001);
    for (const region of face.regions) assert.equal(face.weightsIn(region).jawOpen, 0.25);
  });

test('a late region goes after goals of every frame', async () => {
  const face = await load([{...above, mass: 1, delay: 0.125}]), way = [];
  for (let frame = 0; frame < 60; ++frame) {
    way.push(face.weights.jawOpen);
    assert.ok(Math.abs(face.weightsIn('above').jawOpen - (frame < 8 ? 0 : way[frame - 8])) < 1e-9, `frame ${frame}`);
    face.moveTo({jawOpen: Math.sin(frame / 9)});
    assert.equal(face.advance(1 / 64), true);
  }
});

test('a late region is waited for although it stands at its goal', async () => {
  const face = await load([{...above, mass: 1, delay: 0.5}]);
  for (const jawOpen of [1, 0]) {
    face.moveTo({jawOpen}, 'cut');
    assert.equal(face.advance(0.1), true);
  }
  for (let k = 0; k < 2; ++k) assert.equal(face.advance(0.1), true);
  face.advance(0.15);
  assert.equal(face.weightsIn('above').jawOpen, 1);
});

test('what is set or pushed is no longer waited for in any region', async () => {
  for (const stop of [(face) => face.setWeights({jawOpen: 0.5}, 'above'), (face) => face.reset(),
                      (face) => face.push('jawOpen', 0)]) {
    const face = await load([above]);
    face.setWeights({jawOpen: 1});
    face.moveTo({jawOpen: 0}, {delay: 60}, 'above');
    stop(face);
    face.advance(0.1);
    assert.equal(face.advance(0.1), false);
  }
});

test('all regions go back to 0', async () => {
  const face = await load([above]);
  face.setWeights({jawOpen: 1});
  face.reset();
  for (const region of face.regions) assert.equal(face.weightsIn(region).jawOpen, 0);
});

test('what only a light region cannot follow is refused', async () => {
  const face = await load([{...above, mass: 1e-4}]);
  for (const drive of [{frequency: 2e146}, {kind: 'newton', seconds: 1e-147}])
    assert.throws(() => face.moveTo({jawOpen: 1}, drive), {name: 'RangeError', message: /needs finite numbers/});
});

test('no regions are no division', async () => {
  assert.deepEqual((await load([])).regions, []);
});

test('a goal of one region is its own', async () => {
  const face = await load([above]);
  face.setWeights({browInnerUp: 0.5}, 'above');
  face.moveTo({jawOpen: 1}, {kind: 'accelerate-brake', seconds: 0.2}, 'above');
  let frames = 0;
  while (face.advance(0.05)) assert.ok(++frames < 100);
  assert.equal(face.weights.jawOpen, 0);
  assert.equal(face.weightsIn('above').jawOpen, 1);
  assert.deepEqual([face.weights.browInnerUp, face.weightsIn('above').browInnerUp], [0, 0.5]);
});

test('a timeline moves a region alone, also the rest of a divided face', async () => {
  for (const [region, weights] of [['above', [0, 1]], ['rest', [1, 0]]]) {
    const face = await load([above]), events = [{at: 0, to: {jawOpen: 1}, drive: 'cut', region}];
    new TimelinePlayer(face, readTimeline(JSON.stringify({seconds: 1, events}))).advance(0.5);
    assert.deepEqual([face.weights.jawOpen, face.weightsIn('above').jawOpen], weights);
  }
});

test('regions go with arcs, a level of detail and clones', async () => {
  const face = await load([above], {arcs: true, combine: true, lod: 1}), other = face.clone();
  face.setWeights({browInnerUp: 1, jawOpen: 1}, 'above');
  assert.deepEqual(other.regions, face.regions);
  assert.equal(other.weightsIn('above').jawOpen, 0);
  assert.ok(difference(positionsOf(face), positionsOf(other)).most > 0.01);
});

test('regions are what they were when they were given', async () => {
  const region = {...above, points: [[0, 8, 9]], line: [[0, 8, 9]], parts: [], curves: [], nodes: {}};
  const loading = load([region]);
  region.mass = -5;
  for (const places of [region.points, region.line]) places[0][0] = NaN;
  for (const names of [region.parts, region.curves]) names.push('nothing');
  region.nodes.nothing = 1;
  const face = await loading;
  assert.deepEqual(face.regions, ['rest', 'above']);
  face.moveTo({jawOpen: 1});
});

test('what is no region is refused with a sentence', async () => {
  const refused = async (regions, sentence) => assert.rejects(load(regions), sentence);
  for (const none of [{}, () => 1]) await refused(none, /Regions are a list/);
  await refused([{points: [[0, 0, 0]]}], /A region needs a name\./);
  for (const name of ['a\0b', 'a\n', 'a\ud800']) await refused([{...above, name}], /A region needs a name that is text/);
  await refused([{...above, weight: 1}], /Region 'above' has an unknown 'weight'/);
  for (const nowhere of [{}, {parts: []}, {points: []}, {nodes: {}}])
    await refused([{name: 'above', ...nowhere}], /says nowhere where it is/);
  for (const point of [[0, 0], [0, NaN, 0]]) await refused([{...above, points: [point]}], /not like \[\[x, y, z\]\]/);
  for (const over of ['land', null]) await refused([{...above, over}], /which is neither surface nor space/);
  for (const bands of [0, 1.5]) await refused([{...above, bands}], new RegExp(`${bands} bands`));
  await refused([{...above, fade: -1}], /finite and at least 0/);
  await refused([above, above], /Two regions are named 'above'/);
  await refused([{name: 'x', parts: ['beard']}], /Region 'x': .*beard/);
  await refused([{...above, points: [[1e6, 0, 0]]}], /Region 'above': The brush reaches no node/);
  for (const matter of [{mass: 1e9}, {stiffness: 0}]) await refused([{...above, ...matter}], /from 0\.0001 to 10000/);
  await refused([{...above, mass: 'heavy'}], /Region 'above' has a 'mass' that is not a number\./);
  for (const delay of [-1, 61]) await refused([{...above, delay}], /from 0 to 60 seconds/);
  for (const parts of ['lips', [undefined], [0]]) await refused([{...above, parts}], /'parts' that are no list of names/);
  await refused([{...above, curves: [0]}], /'curves' that are no list of names/);
  await refused([{...above, points: null}], /'points' that are not like/);
  for (const nodes of [null, [1], [], {a: 'x'}]) await refused([{...above, nodes}], /'nodes' that are no shares/);
  await refused([{...above, bands: 1e9}], /whole number from 1 to 32/);
  assert.deepEqual((await load([{...above, mass: undefined}])).regions, ['rest', 'above']);
});
