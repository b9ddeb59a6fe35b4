import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {difference, newFolder, played, sample, tool} from './native.js';
import {assertTellsWhetherToDraw} from './updates.js';

const three = await import('three').catch(() => undefined);
const options = {skip: three ? false : 'three is not installed; try npm ci'};

/** Materials for all parts of a face, the last one for the rest of them. */
const each = ({parts}, ...few) => parts.map((_, k) => few[Math.min(k, few.length - 1)]);

async function load() {
  const {SweepfaceLoader} = await import('../sweepface_three.js');
  return new SweepfaceLoader().parseAsync(readFileSync(sample));
}

test('a mesh follows its weights when it is updated', options, async () => {
  const mesh = await load(), {position, normal} = mesh.geometry.attributes;
  const neutral = position.array.slice(), {version} = position;
  mesh.setWeights({jawOpen: 0.7});
  assert.deepEqual(position.array, neutral);
  mesh.update();
  assert.ok(position.version > version);
  assert.ok(normal.version > 0);
  const native = played(sample, mesh.face.weights, 0);
  assert.ok(difference(native.positions, position.array).most <= native.error);
});

test('a mesh goes back to its neutral', options, async () => {
  const mesh = await load(), {array} = mesh.geometry.attributes.position, neutral = array.slice();
  mesh.setWeights({jawOpen: 0.7});
  mesh.update();
  mesh.reset();
  mesh.update();
  assert.deepEqual(array, neutral);
});

test('what moves morph targets moves a mesh', options, async () => {
  const mesh = await load(), {morphTargetDictionary: places, morphTargetInfluences: influences} = mesh;
  assert.deepEqual(Object.keys(places), mesh.names);
  influences[places.jawOpen] = 0.7;
  mesh.update();
  assert.equal(mesh.weights.jawOpen, 0.7);
  const native = played(sample, mesh.weights, 0);
  assert.ok(difference(native.positions, mesh.geometry.attributes.position.array).most <= native.error);
  mesh.setWeights({mouthSmileLeft: 0.5});
  assert.equal(influences[places.mouthSmileLeft], 0.5);
  influences[places.mouthSmileLeft] = 0.25;  // which setting others before it is shown leaves alone
  mesh.setWeights({jawOpen: 0});
  assert.deepEqual([mesh.weights.mouthSmileLeft, influences[places.jawOpen]], [0.25, 0]);
  mesh.moveTo({jawOpen: 1}, {kind: 'linear-force', seconds: 0.1});
  for (let k = 0; k < 20; ++k) mesh.update(1 / 60);
  assert.equal(influences[places.jawOpen], 1);
  influences[places.jawOpen] = 0.5;
  assert.equal(mesh.clone().morphTargetInfluences[places.jawOpen], 0.5);
  for (const odd of [NaN, Infinity, -2e6, '0.25', undefined]) {
    influences[places.jawOpen] = odd;
    mesh.update();
    assert.equal(mesh.weights.jawOpen, 0.5);
  }
  mesh.reset();
  assert.deepEqual(influences, mesh.names.map(() => 0));
});

test('a target may have any name', options, async () => {
  const {SweepfaceMesh} = await import('../sweepface_three.js'), folder = newFolder(), file = join(folder, 'odd.sweep');
  const [neutral, odd] = ['neutral.obj', '__proto__.obj'].map((name) => join(folder, name));
  execFileSync(tool, ['export', sample, '-o', neutral, '--quiet']);
  execFileSync(tool, ['export', sample, '-o', odd, '--weights', 'jawOpen=1', '--quiet']);
  execFileSync(tool, ['convert', neutral, odd, '-o', file, '--tolerance', '0.5', '--quiet']);
  const {Sweepface} = await import('../sweepface.js'), mesh = new SweepfaceMesh(await Sweepface.load(readFileSync(file)));
  mesh.morphTargetInfluences[0] = 0.9;
  mesh.update();
  assert.deepEqual(mesh.face.weightValues, new Float64Array([0.9]));
});

test('forces set out from where the influences were set to', options, async () => {
  const mesh = await load(), {morphTargetInfluences: influences} = mesh, {jawOpen: k} = mesh.morphTargetDictionary;
  influences[k] = 0.5;
  mesh.moveTo({jawOpen: 1}, {kind: 'linear-force', seconds: 0.1});
  for (let twice = 0; twice < 2; ++twice) mesh.update(0.2);  // until it rests
  assert.equal(mesh.weights.jawOpen, 1);
  influences[k] = 0.25;
  mesh.push('jawOpen', 1, 4);
  mesh.update(5);
  assert.ok(Math.abs(mesh.weights.jawOpen - 0.5) < 1e-6);
  mesh.moveTo({browInnerUp: 1});
  influences[k] = 0.75;
  mesh.advance(0.1);
  assert.equal(mesh.weights.jawOpen, 0.75);
});

test('influences may be an array of another kind', options, async () => {
  const mesh = await load(), {jawOpen} = mesh.morphTargetDictionary;
  const end = () => {
    mesh.reset();
    mesh.moveTo({jawOpen: 0.7}, {kind: 'linear-force', seconds: 0.1});
    for (let k = 0; k < 20; ++k) mesh.update(1 / 60);
    return mesh.weights.jawOpen;
  };
  mesh.morphTargetInfluences = new Float32Array(mesh.names.length);  // which rounds 0.7
  assert.equal(end(), 0.7);
  mesh.morphTargetInfluences[jawOpen] = 0.25;
  mesh.update();
  assert.equal(mesh.weights.jawOpen, 0.25);
  for (const odd of [Object.freeze(mesh.names.map(() => 0)), [0], undefined, null]) {
    mesh.morphTargetInfluences = odd;
    assert.equal(end(), 0.7);
    assert.ok(mesh.morphTargetInfluences === odd && odd?.length !== 2);
  }
  const twin = mesh.clone();
  assert.equal(twin.morphTargetInfluences[jawOpen], 0.7);
  twin.copy(new three.Mesh());
  assert.equal(twin.morphTargetInfluences[twin.morphTargetDictionary.jawOpen], 0.7);
});

test("three.js's mixer plays clips on a mesh, by name and of all targets together", options, async () => {
  const mesh = await load(), {position} = mesh.geometry.attributes;
  const byName = new three.NumberKeyframeTrack('.morphTargetInfluences[jawOpen]', [0, 1], [0, 1]);
  const all = new three.NumberKeyframeTrack('.morphTargetInfluences', [0, 1], [0, 1].flatMap((w) => mesh.names.map(() => w)));
  for (const [track, others] of [[byName, 0], [all, 0.5]]) {
    mesh.reset();
    mesh.update();
    const {version} = position, mixer = new three.AnimationMixer(mesh);
    mixer.clipAction(new three.AnimationClip('take', 1, [track])).play();
    mixer.update(0.5);
    mesh.update();
    assert.ok(position.version > version);
    assert.deepEqual(Object.values(mesh.weights), mesh.names.map((name) => (name === 'jawOpen' ? 0.5 : others)));
    mixer.stopAllAction();
  }
});

test('animations of glTF files move the targets that they name', options, async () => {
  const {animationFor} = await import('../sweepface_three.js');
  const {GLTFLoader} = await import('three/examples/jsm/loaders/GLTFLoader.js');
  globalThis.self ??= globalThis;  // as the loader expects it
  const take = join(newFolder(), 'take.glb');
  execFileSync(tool, ['animate', sample, '--to', 'jawOpen=1', '--law', 'newton', '-o', take, '--quiet']);
  const gltf = await new GLTFLoader().parseAsync(new Uint8Array(readFileSync(take)).buffer, '');
  const mesh = await load(), clip = animationFor(mesh, gltf), mixer = new three.AnimationMixer(mesh);
  assert.deepEqual(clip.tracks.map(({name}) => name), ['.morphTargetInfluences[jawOpen]']);
  mixer.clipAction(clip).play();
  mesh.moveTo({mouthSmileLeft: 1}, {kind: 'linear-force', seconds: 0.2});  // which goes on
  for (const seconds of [0.25, 0.25]) {
    mixer.update(seconds);
    mesh.update(seconds);
  }
  assert.ok(Math.abs(mesh.weights.jawOpen - 0.25) < 1e-6);
  assert.equal(mesh.weights.mouthSmileLeft, 1);
  assert.throws(() => animationFor(mesh, undefined), {message: /^animationFor takes a face/});
});

test('animations are matched by names, whichever meshes and tracks have them', options, async () => {
  const {animationFor} = await import('../sweepface_three.js');
  const meshOf = (name, ...targets) => {
    const morphTargetDictionary = Object.fromEntries(targets.map((target, k) => [target, k]));
    return Object.assign(new three.Mesh(), {name, morphTargetDictionary, morphTargetInfluences: targets.map(() => 0)});
  };
  // Of two targets without a name three.js knows only the last.
  const scene = new three.Group().add(meshOf('teeth', 'smile', 'jawOpen'), meshOf('head', '', '', 'jawOpen', 'blink'));
  const track = (name, values, times = [0, 1]) => new three.NumberKeyframeTrack(name, times, values);
  const animations = [
    new three.AnimationClip('walk', 1, [new three.VectorKeyframeTrack('head.position', [0], [1, 2, 3])]),
    new three.AnimationClip('talk', 2, [track('teeth.morphTargetInfluences', [0, 0, 0.5, 1]),
                                        track('head.morphTargetInfluences', [7, 8, 9, 2, 7, 8, 9, 4])]),
    new three.AnimationClip('wink', 1, [track('head.morphTargetInfluences[3]', [0, 0.5]),
                                        track('teeth.morphTargetInfluences[smile]', [0, 0])])
  ];
  const face = {names: ['jawOpen', 'blink', 'smile']}, gltf = {scene, animations};
  const told = (clip) => clip.tracks.map(({name, values}) => [name, ...values]), talk = animationFor(face, gltf);
  assert.deepEqual([talk.name, talk.duration], ['talk', 2]);
  assert.deepEqual(told(talk), [['.morphTargetInfluences[smile]', 0, 0.5], ['.morphTargetInfluences[jawOpen]', 0, 1],
                                ['.morphTargetInfluences[blink]', 2, 4]]);
  assert.deepEqual(told(animationFor(face, gltf, animations[2])), [['.morphTargetInfluences[blink]', 0, 0.5]]);
  const spline = track('teeth.morphTargetInfluences', [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);  // tangents beside values
  spline.createInterpolant = () => 'cubic';
  const [smile, open] = animationFor(face, {scene, animations: [new three.AnimationClip('talk', 1, [spline])]}).tracks;
  assert.deepEqual([[...smile.values], [...open.values]], [[0, 2, 4, 6, 8, 10], [1, 3, 5, 7, 9, 11]]);
  assert.equal(smile.createInterpolant(), 'cubic');
  const lacks = {message: /^The file has no animation of targets that the face has/};
  assert.throws(() => animationFor(face, gltf, animations[0]), lacks);
  assert.throws(() => animationFor({names: ['frown']}, gltf), lacks);
});

test('an update costs nothing where nothing moves', options, async () => {
  const mesh = await load(), {position} = mesh.geometry.attributes;
  const {version} = position;
  mesh.update(1 / 60);
  assert.equal(position.version, version);
  mesh.moveTo({jawOpen: 1}, {kind: 'linear-force', seconds: 0.1});
  for (let k = 0; k < 20; ++k) mesh.update(1 / 60);
  const after = position.version;
  assert.ok(after > version);
  assert.equal(mesh.face.weights.jawOpen, 1);
  mesh.update(1 / 60);
  assert.equal(position.version, after);
});

test('an update tells whether there is something to draw', options, async () => {
  assertTellsWhetherToDraw(await load());
});

test('vertices are moved by the mesh or in a clone of the geometry, as they follow the face', options, async () => {
  const {geometry} = await load(), {array} = geometry.attributes.position, before = array.slice();
  for (const move of [() => geometry.scale(2, 2, 2), () => geometry.center(), () => geometry.rotateX(1)])
    assert.throws(move, /The vertices follow the face; move, turn or scale the mesh/);
  assert.deepEqual(array, before);
  assert.equal(geometry.clone().scale(2, 2, 2).attributes.position.array[0], 2 * array[0]);
});

test('the sphere around a face is the one that three.js finds', options, async () => {
  const mesh = await load(), {geometry} = mesh, first = geometry.boundingSphere.radius;
  mesh.setWeights({jawOpen: 9});
  mesh.update();
  const {center, radius} = geometry.boundingSphere.clone();
  geometry.computeBoundingSphere();
  assert.ok(center.distanceTo(geometry.boundingSphere.center) < 1e-5);
  assert.ok(Math.abs(radius - geometry.boundingSphere.radius) < 1e-5);
  assert.notEqual(radius, first);
});

test('a slow motion moves a mesh, and one that waits uploads nothing once it is over', options, async () => {
  const mesh = await load(), {position} = mesh.geometry.attributes;
  mesh.moveTo({jawOpen: 0.2}, {kind: 'accelerate-brake', seconds: 2});
  for (const tiny of [0, 1e-9]) mesh.advance(tiny);
  for (let k = 0; k < 180; ++k) mesh.update(1 / 60);
  assert.equal(mesh.face.weights.jawOpen, 0.2);
  const {version} = position;
  for (let k = 0; k < 10; ++k) {
    assert.equal(mesh.advance(1 / 60), false);
    mesh.update();
  }
  assert.equal(position.version, version);
  for (const wait of [(seconds) => mesh.update(seconds), (seconds) => mesh.advance(seconds)])
    for (const seconds of [NaN, Infinity]) assert.throws(() => wait(seconds), /finite number of seconds/);
});

for (const [name, module] of [['SweepfaceMesh', 'three'], ['SweepfaceGpuMesh', 'gpu']])
  test(`${name} can be cloned, by itself and within a scene`, options, async () => {
    const {Sweepface} = await import('../sweepface.js'), Made = (await import(`../sweepface_${module}.js`))[name];
    const regions = [{name: 'above', points: [[0, 8, 9]], whole: 5, over: 'space'}];
    const mesh = new Made(await Sweepface.load(readFileSync(sample), {regions})), group = new three.Group();
    mesh.setWeights({jawOpen: 0.5});
    mesh.setWeights({browInnerUp: 0.25}, 'above');
    mesh.update();
    mesh.position.set(1, 2, 3);
    mesh.add(new three.Mesh(mesh.geometry));  // as for showing its inside
    group.add(mesh);
    for (const twin of [mesh.clone(), group.clone().children[0]]) {
      assert.ok(twin instanceof Made && twin.face !== mesh.face && twin.geometry !== mesh.geometry);
      for (const region of mesh.regions) assert.deepEqual(twin.face.weightsIn(region), mesh.face.weightsIn(region));
      assert.deepEqual(twin.geometry.attributes.position.array, mesh.geometry.attributes.position.array);
      assert.deepEqual(twin.position.toArray(), [1, 2, 3]);
      assert.deepEqual(twin.children.map(({geometry}) => geometry), [twin.geometry]);
      assert.equal(twin.material.length, mesh.material.length);
      assert.equal(twin.material[0] === mesh.material[0], name === 'SweepfaceMesh');
      twin.setWeights({jawOpen: 1});
      twin.update();
      assert.equal(mesh.face.weights.jawOpen, 0.5);
    }
    assert.equal(mesh.clone(false).children.length, 0);
  });

for (const [name, module] of [['SweepfaceMesh', 'three'], ['SweepfaceGpuMesh', 'gpu']])
  test(`clones of a ${name} have once what is fixed, and what was put in its place`, options, async () => {
    const {Sweepface} = await import('../sweepface.js'), Made = (await import(`../sweepface_${module}.js`))[name];
    const mesh = new Made(await Sweepface.load(readFileSync(sample))), {geometry} = mesh, {uv, position} = geometry.attributes;
    const twin = mesh.clone().clone().geometry;
    assert.notEqual(twin.index, geometry.index);
    assert.deepEqual(twin.index.array, geometry.index.array);
    assert.equal(twin.attributes.uv, uv);
    assert.equal(twin.attributes.position === position, name === 'SweepfaceGpuMesh');
    geometry.setAttribute('uv', uv.clone());
    geometry.attributes.uv.array.fill(0.5);
    geometry.setIndex([0, 1, 2]);
    const other = mesh.clone().geometry;
    for (const [own, theirs] of [[geometry.attributes.uv, other.attributes.uv], [geometry.index, other.index]]) {
      assert.deepEqual(theirs.array, own.array);
      assert.notEqual(theirs, own);
    }
    assert.equal(twin.attributes.uv, uv);
    mesh.material.pop();
    geometry.groups.pop();
    assert.equal(mesh.clone().material.length, mesh.material.length);
    for (const key of ['uv', 'normal']) geometry.deleteAttribute(key);
    const bare = mesh.clone();
    assert.deepEqual(Object.keys(bare.geometry.attributes), Object.keys(geometry.attributes));
    bare.geometry.setIndex(null);
    bare.material = bare.material[0];
    const rays = new three.Raycaster(new three.Vector3(0, 0, 99), new three.Vector3(0, 0, -1));
    assert.ok(rays.intersectObject(bare).length > 0);
  });

for (const [name, module] of [['SweepfaceMesh', 'three'], ['SweepfaceGpuMesh', 'gpu']])
  test(`classes made of ${name} may have methods of any name`, options, async () => {
    const {Sweepface} = await import('../sweepface.js'), Made = (await import(`../sweepface_${module}.js`))[name];
    class Mine extends Made {
      show() { this.visible = true; }
      follow() { throw new Error('follows somebody'); }
      meet() { throw new Error('meets somebody'); }
      share() { throw new Error('shares something'); }
    }
    const mesh = new Mine(await Sweepface.load(readFileSync(sample))), usual = await load();
    mesh.setWeights({jawOpen: 1});
    mesh.update();
    mesh.raycast(new three.Raycaster(), []);
    mesh.clone();
    assert.deepEqual(mesh.weights, mesh.face.weights);
    assert.equal(mesh.weights.jawOpen, 1);
    usual.setWeights({jawOpen: 1});
    usual.update();
    if (name === 'SweepfaceMesh')
      assert.deepEqual(mesh.geometry.attributes.position.array, usual.geometry.attributes.position.array);
  });

test('what clones share stays while another is shown, whoever listens from the start', options, async () => {
  const {Sweepface} = await import('../sweepface.js'), {SweepfaceMesh} = await import('../sweepface_three.js');
  const gone = [];  // what three.js would free on the graphics card
  class Mine extends SweepfaceMesh {
    constructor(face, materials) {
      super(face, materials);
      this.geometry.addEventListener('dispose', ({target}) => gone.push(target.attributes.uv.count > 0));
    }
  }
  const mesh = new Mine(await Sweepface.load(readFileSync(sample))), twin = mesh.clone();
  for (let twice = 0; twice < 2; ++twice) twin.geometry.dispose();
  twin.dispose();
  mesh.dispose();
  assert.deepEqual(gone, [false, false, false, true]);
});

test('who listens to something else does not show what clones share', options, async () => {
  const mesh = await load(), gone = [];
  mesh.clone().geometry.addEventListener('renamed', () => {});
  mesh.geometry.addEventListener('dispose', ({target}) => gone.push(target.attributes.uv.count > 0));
  mesh.geometry.dispose();
  assert.deepEqual(gone, [true]);
});

test('cuts show at once, also where time stands still', options, async () => {
  const mesh = await load();
  mesh.moveTo({jawOpen: 1}, 'cut');
  mesh.moveTo({browInnerUp: 1}, {kind: 'spring', frequency: 2});
  mesh.update();
  assert.equal(mesh.weights.jawOpen, 1);
  assert.equal(mesh.weights.browInnerUp, 0);
  assert.ok(mesh.advance(0.1));
});

test('a mesh makes ready to move', options, async () => {
  const mesh = await load(), before = mesh.face.memoryBytes;
  mesh.prepare();
  const ready = mesh.face.memoryBytes;
  assert.ok(ready > before);
  mesh.setWeights({jawOpen: 1});
  mesh.update();
  assert.equal(mesh.face.memoryBytes, ready);
});

test('a geometry of other vertices is refused, and bounds are made for those who look', options, async () => {
  const mesh = await load();
  mesh.frustumCulled = false;
  mesh.setWeights({jawOpen: 1});
  mesh.update();
  assert.equal(mesh.geometry.boundingSphere, null);
  mesh.geometry = mesh.geometry.toNonIndexed();
  mesh.setWeights({jawOpen: 0});
  assert.throws(() => mesh.update(), /^Error: The geometry must have the \d+ vertices of the face/);
});

test('clones have what was put into a geometry', options, async () => {
  const mesh = await load(), {geometry} = mesh, colour = new three.BufferAttribute(new Float32Array(3), 3);
  geometry.setAttribute('color', colour);
  geometry.groups.pop();
  geometry.setDrawRange(3, 300);
  Object.assign(geometry, {name: 'mine', userData: {mine: 1}});
  const twin = mesh.clone().geometry;
  assert.notEqual(twin.attributes.color, colour);
  assert.deepEqual(twin.attributes.color.array, colour.array);
  assert.notEqual(twin.attributes.position, geometry.attributes.position);
  assert.deepEqual(twin.groups, geometry.groups);
  assert.notEqual(twin.groups[0], geometry.groups[0]);
  assert.deepEqual([twin.drawRange, twin.name, twin.userData], [{start: 3, count: 300}, 'mine', {mine: 1}]);
});

test('what is no face is refused with a sentence', options, async () => {
  const {SweepfaceMesh} = await import('../sweepface_three.js');
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  for (const Mesh of [SweepfaceMesh, SweepfaceGpuMesh])
    for (const slip of [Promise.resolve(), new ArrayBuffer(8), undefined])
      assert.throws(() => new Mesh(slip), {message: /^A mesh is made of a face; await Sweepface\.load/});
});

for (const [name, module] of [['SweepfaceMesh', 'three'], ['SweepfaceGpuMesh', 'gpu']])
  test(`${name} takes over a face as it moves and looks`, options, async () => {
    const {Sweepface} = await import('../sweepface.js'), Made = (await import(`../sweepface_${module}.js`))[name];
    const face = await Sweepface.load(readFileSync(sample), {eyes: true});
    face.moveTo({jawOpen: 1});
    face.look({leftEye: {yaw: 0.3}});
    const mesh = new Made(face);
    for (let frame = 0; frame < 120; ++frame) mesh.update(1 / 60);
    assert.ok(face.weights.jawOpen > 0.99);
    assert.deepEqual(mesh.clone().face.pose, face.pose);
  });

for (const [name, module] of [['SweepfaceMesh', 'three'], ['SweepfaceGpuMesh', 'gpu']])
  test(`${name} has the regions and the eyes of its face`, options, async () => {
    const {Sweepface} = await import('../sweepface.js'), Made = (await import(`../sweepface_${module}.js`))[name];
    const regions = [{name: 'above', points: [[0, 8, 9]], whole: 5, over: 'space'}], pose = {leftEye: {yaw: 0.3}, rightEye: {}};
    const mesh = new Made(await Sweepface.load(readFileSync(sample), {regions, eyes: true}));
    mesh.moveTo({jawOpen: 1}, 'cut', 'above');
    assert.deepEqual(mesh.regions.map((region) => mesh.weightsIn(region).jawOpen), [0, 1]);
    mesh.look(pose);
    assert.deepEqual([mesh.eyeCount, mesh.pose], [2, pose]);
  });

test('other materials see the neutral of a face on the graphics card', options, async () => {
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  const usual = await load(), mesh = new SweepfaceGpuMesh((await load()).face);
  assert.equal(mesh.frustumCulled, false);  // bounds are of the neutral, too
  const {normal: {array}} = mesh.geometry.attributes, expected = usual.geometry.attributes.normal.array;
  assert.ok(array.every((x, k) => Math.abs(x - expected[k]) < 1e-3));
  assert.throws(() => new SweepfaceGpuMesh(usual.face, [null]), {name: 'TypeError', message: /takes a material/});
});

for (const [name, module] of [['SweepfaceMesh', 'three'], ['SweepfaceGpuMesh', 'gpu']])
  test(`${name} takes materials, and at least one`, options, async () => {
    const {face} = await load(), Made = (await import(`../sweepface_${module}.js`))[name];
    const basic = new three.MeshBasicMaterial();
    for (const no of [null, [null], [], 'red', new three.Texture(), each(face, basic, undefined), [basic]])
      assert.throws(() => new Made(face, no), {name: 'TypeError', message: /^A mesh takes a material, or one .* are \d+\.$/});
    assert.equal(new Made(face, basic).material, basic);
  });

test('shaders that cannot follow a face are refused, and nothing changes', options, async () => {
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js'), {face} = await load();
  const plain = new three.MeshStandardMaterial(), {onBeforeCompile} = plain, {GLSL3} = three;
  const follows = 'void main() {\n#include <begin_vertex>\n}', stays = 'void main() { gl_Position = vec4(position, 1.0); }';
  const {ShaderMaterial, RawShaderMaterial} = three;
  for (const [Shader, given, sentence] of [
         [ShaderMaterial, {vertexShader: stays}, /^The material 'mine' has no `#include <begin_vertex>` in/],
         [RawShaderMaterial, {vertexShader: stays, glslVersion: GLSL3}, /has no `#include <begin_vertex>`/],
         [RawShaderMaterial, {vertexShader: follows}, /^The material 'mine' is written in GLSL ES 1/]]) {
    const materials = each(face, plain, new Shader({...given, name: 'mine'}));
    assert.throws(() => new SweepfaceGpuMesh(face, materials), {name: 'TypeError', message: sentence});
    assert.equal(plain.onBeforeCompile, onBeforeCompile);
  }
  new SweepfaceGpuMesh(face, each(face, plain, new ShaderMaterial({vertexShader: follows}),
                                  new RawShaderMaterial({vertexShader: follows, glslVersion: GLSL3})));
});

test('materials on the graphics card follow one face at a time', options, async () => {
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  const material = new three.MeshNormalMaterial(), {onBeforeCompile} = material;
  const {face} = await load(), mesh = new SweepfaceGpuMesh((await load()).face, each(face, material));
  assert.throws(() => new SweepfaceGpuMesh(face, material),
                {name: 'TypeError', message: /^The material 'MeshNormalMaterial' follows a face already; .* clone\(\)/});
  for (const put of [new three.MeshBasicMaterial(), material]) {  // away, and back again
    mesh.material = put;
    mesh.update();
    assert.equal(material.onBeforeCompile === onBeforeCompile, put !== material);
  }
  mesh.material = new three.MeshBasicMaterial();  // without update(), the mesh still owns the other
  mesh.dispose();
  assert.equal(material.onBeforeCompile, onBeforeCompile);
  new SweepfaceGpuMesh(face, material);
});

test('clones look where their models look', options, async () => {
  const {Sweepface} = await import('../sweepface.js'), {SweepfaceMesh} = await import('../sweepface_three.js');
  const mesh = new SweepfaceMesh(await Sweepface.load(readFileSync(sample), {eyes: true}));
  const places = (of) => (of.update(), of.geometry.attributes.position.array);
  const ahead = places(mesh).slice(), straight = mesh.clone();
  const pose = {leftEye: {yaw: 0.3}, rightEye: {yaw: 0.3}};
  mesh.look(pose);
  pose.leftEye.yaw = -1;  // the mesh has a copy
  const aside = places(mesh), twin = mesh.clone();
  assert.deepEqual(twin.geometry.attributes.position.array, aside);
  assert.deepEqual(twin.clone().geometry.attributes.position.array, aside);
  assert.notDeepEqual(aside, ahead);
  assert.deepEqual(places(straight), ahead);
});

test('rays meet a face on the graphics card where they meet one that is not', options, async () => {
  const {Sweepface} = await import('../sweepface.js'), {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  const usual = await load(), mesh = new SweepfaceGpuMesh(await Sweepface.load(readFileSync(sample)));
  const {position} = mesh.geometry.attributes, neutral = position.array.slice(), down = new three.Vector3(0, 0, -1);
  mesh.geometry.computeBoundingSphere();  // of the neutral
  mesh.geometry.computeBoundingBox();
  let moved = 0, lowest = 0;
  for (let y = -30; y <= 10; y += 2) {
    const rays = new three.Raycaster(new three.Vector3(0.3, y, 100), down);
    const hits = [{jawOpen: 0}, {jawOpen: 8}].map((weights) => {
      const [here, there] = [usual, mesh].map((each) => {
        each.setWeights(weights);
        each.update();
        return rays.intersectObject(each).map(({point, normal}) => [point.toArray(), normal?.toArray()]);
      });
      assert.deepEqual(there, here);
      return here;
    });
    moved += JSON.stringify(hits[0]) !== JSON.stringify(hits[1]);
    if (hits[1].length > 0) lowest = Math.min(lowest, y);
  }
  assert.ok(moved > 3);
  assert.ok(lowest < mesh.geometry.boundingBox.min.y);
  assert.equal(mesh.geometry.attributes.position, position);
  assert.deepEqual(position.array, neutral);
});

test('rays evaluate a face on the graphics card once for each expression, without a tree of its neutral', options, async () => {
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js'), mesh = new SweepfaceGpuMesh((await load()).face);
  const {face, geometry} = mesh, evaluate = face.evaluate.bind(face), boundsTree = {}, {raycast} = three.Mesh.prototype;
  const rays = new three.Raycaster(new three.Vector3(0, 0, 100), new three.Vector3(0, 0, -1));
  let count = 0, seen;
  face.evaluate = (...given) => { ++count; evaluate(...given); };
  geometry.boundsTree = boundsTree;
  three.Mesh.prototype.raycast = function(...given) {  // as three-mesh-bvh has it
    seen = this.geometry.boundsTree;
    raycast.call(this, ...given);
  };
  try {
    for (const times of [1, 2, 3]) assert.ok(rays.intersectObject(mesh).length > 0, times);
    assert.equal(count, 1);
    mesh.setWeights({jawOpen: 1});
    for (let k = 0; k < 2; ++k) rays.intersectObject(mesh);
    assert.equal(count, 2);
    geometry.deleteAttribute('normal');
    assert.equal(rays.intersectObject(mesh)[0].normal, undefined);
    assert.equal(seen, undefined);
    assert.equal(geometry.boundsTree, boundsTree);
  } finally {
    three.Mesh.prototype.raycast = raycast;
  }
});

test('meshes on the graphics card say which renderer they are for, once', options, async (context) => {
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js'), {SweepfaceNodeMesh} = await import('../sweepface_webgpu.js');
  const {face} = await load(), said = [];
  context.mock.method(console, 'error', (sentence) => said.push(sentence));
  const meshes = [SweepfaceGpuMesh, SweepfaceGpuMesh, SweepfaceNodeMesh, SweepfaceNodeMesh].map((Made) => new Made(face.clone()));
  for (const mesh of meshes) for (const renderer of [{isWebGLRenderer: true}, {isRenderer: true}]) mesh.onBeforeRender(renderer);
  assert.deepEqual(said, ['WebGPURenderer draws the neutral of every SweepfaceGpuMesh; make a SweepfaceNodeMesh for it.',
                          'WebGLRenderer draws the neutral of every SweepfaceNodeMesh; make a SweepfaceGpuMesh for it.']);
});

test('materials keep what they do to a shader, and their clones too', options, async () => {
  const {Sweepface} = await import('../sweepface.js'), {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  const face = await Sweepface.load(readFileSync(sample));
  const [mine, other] = ['mine', 'other'].map((key) => Object.assign(new three.MeshStandardMaterial(), {
    onBeforeCompile: (shader, renderer) => { shader.vertexShader += `// ${key} by ${renderer}`; },
    customProgramCacheKey: () => key
  }));
  const [one, two] = [() => 1, () => 2].map((onBeforeCompile) => {
    return Object.assign(new three.MeshBasicMaterial(), {onBeforeCompile});
  });
  const mesh = new SweepfaceGpuMesh(face, each(face, mine, mine, other, one, two)), [twin] = mesh.clone().material;
  assert.notEqual(one.customProgramCacheKey(), two.customProgramCacheKey());
  for (const material of [mine, twin]) {
    const shader = {uniforms: {}, vertexShader: '#include <begin_vertex>'};
    material.onBeforeCompile(shader, 'me');
    assert.match(shader.vertexShader, /\/\/ mine by me/);
    assert.equal(shader.vertexShader.match(/uniform float sweepFactor/g).length, 1);
  }
  assert.notEqual(mine.customProgramCacheKey(), other.customProgramCacheKey());
  assert.equal(mine.customProgramCacheKey(), twin.customProgramCacheKey());
  const plain = new three.MeshStandardMaterial(), same = new three.MeshStandardMaterial();
  same.customProgramCacheKey = () => '';
  new SweepfaceGpuMesh(await Sweepface.load(readFileSync(sample)), same);
  assert.notEqual(same.customProgramCacheKey(), plain.customProgramCacheKey());  // which knows no face
});

test('a hook that is put in later stays when the mesh goes', options, async () => {
  const {Sweepface} = await import('../sweepface.js'), {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  const material = new three.MeshStandardMaterial(), {customProgramCacheKey} = material, hook = () => {};
  const mesh = new SweepfaceGpuMesh(await Sweepface.load(readFileSync(sample)), material);
  material.onBeforeCompile = hook;
  mesh.dispose();
  assert.equal(material.onBeforeCompile, hook);
  assert.equal(material.customProgramCacheKey, customProgramCacheKey);
});

test('a loader tells that its options come second', options, async () => {
  const {SweepfaceLoader} = await import('../sweepface_three.js');
  assert.throws(() => new SweepfaceLoader({lod: 2}), /its options after it/);
  assert.deepEqual(new SweepfaceLoader(undefined, null).options, {});
});

test('a loader makes the mesh that it is told to', options, async () => {
  const {SweepfaceLoader, SweepfaceMesh} = await import('../sweepface_three.js'), bytes = readFileSync(sample);
  const {SweepfaceGpuMesh} = await import('../sweepface_gpu.js');
  class Mine extends SweepfaceMesh {}
  const loader = new SweepfaceLoader(undefined, {mesh: SweepfaceGpuMesh, lod: 2}), made = await loader.parseAsync(bytes);
  assert.ok(made instanceof SweepfaceGpuMesh);
  assert.equal(made.face.lod, 2);
  assert.equal((await loader.parseAsync(bytes, {mesh: Mine})).constructor, Mine);
  assert.equal((await loader.parseAsync(bytes, null)).face.lod, 2);
  const {face, constructor} = await loader.parseAsync(bytes, {mesh: undefined, lod: undefined});
  assert.deepEqual([constructor, face.lod], [SweepfaceGpuMesh, 2]);
  assert.ok((await loader.parseAsync(bytes, {vertices: 5000, mesh: SweepfaceMesh})).face.pointCount <= 5000);
  for (const mesh of [null, 'SweepfaceGpuMesh', three.Mesh, {}])
    await assert.rejects(loader.parseAsync(bytes, {mesh}), /^TypeError: The option 'mesh' is a class: /);
});

/** The events of a load, in order. */
async function happenings(file, options, fail = () => {}) {
  const {SweepfaceLoader} = await import('../sweepface_three.js'), seen = [];
  const manager = new three.LoadingManager(() => seen.push('all'), undefined, () => seen.push('amiss'));
  let all;
  const done = new Promise((resolve) => all = resolve);
  manager.onLoad = () => {
    seen.push('all');
    all();
  };
  new SweepfaceLoader(manager, options).load(file, () => {
    seen.push('mesh');
    fail();
  }, undefined, ({message}) => seen.push(message));
  await done;
  return seen;
}

test('a manager hears of a mesh when it is there, and once of what goes wrong', options, async () => {
  const {fetch} = globalThis;
  globalThis.ProgressEvent ??= class { constructor(type) { this.type = type; } };
  globalThis.fetch = async (request) => {
    const name = new URL(request.url).pathname;
    if (name === '/none') return new Response('', {status: 404});
    return new Response(name === '/bad' ? 'GIF' : readFileSync(sample));
  };
  try {
    assert.deepEqual(await happenings('http://a/face'), ['mesh', 'all']);
    const [missing, ...rest] = await happenings('http://a/none');
    assert.match(missing, /404/);
    assert.deepEqual(rest, ['amiss', 'all']);
    assert.match((await happenings('http://a/bad', {name: 'Anna'})).join(), /^amiss,Anna does not begin with .*,all$/);
    for (const options of [undefined, {name: ''}])
      assert.match((await happenings('http://a/bad', options)).join(), /http:\/\/a\/bad does not begin with/);
    const mine = () => { throw new Error('Mine.'); };
    assert.deepEqual(await happenings('http://a/face', {}, mine), ['mesh', 'amiss', 'Mine.', 'all']);
  } finally {
    globalThis.fetch = fetch;
  }
});

test('a loader aborts its downloads', {...options, timeout: 10_000}, async () => {
  const {fetch} = globalThis, {SweepfaceLoader} = await import('../sweepface_three.js'), loader = new SweepfaceLoader();
  globalThis.fetch = ({signal}) => new Promise((_, reject) => {
    signal.addEventListener('abort', () => reject(signal.reason));
  });
  try {
    const all = ['http://a/one', 'http://a/two'].map((url) => assert.rejects(loader.loadAsync(url), {name: 'AbortError'}));
    assert.equal(loader.abort(), loader);
    await Promise.all(all);
  } finally {
    globalThis.fetch = fetch;
  }
});

test('a loader that is aborted hands over no face', {...options, timeout: 10_000}, async () => {
  const {fetch} = globalThis, {SweepfaceLoader, SweepfaceMesh} = await import('../sweepface_three.js'), made = [];
  class Mine extends SweepfaceMesh {
    constructor(...given) {
      super(...given);
      made.push(this);
      loader.abort();  // when all is there, but nobody knows yet
    }
  }
  const loader = new SweepfaceLoader(undefined, {mesh: Mine});
  globalThis.fetch = async () => new Response(readFileSync(sample));
  try {
    await assert.rejects(loader.loadAsync('http://a/face'), {name: 'AbortError'});
    assert.throws(() => made[0].face.names, /disposed of/);
  } finally {
    globalThis.fetch = fetch;
  }
});

test('a loader tells of what is no URL, and takes no path for options', options, async () => {
  const {SweepfaceLoader} = await import('../sweepface_three.js');
  for (let k = 0; k < 2; ++k) assert.match((await happenings('http://[')).join(), /^amiss,all,.*URL/);
  const bytes = `data:application/octet-stream;base64,${'QUJD'.repeat(2000)}`;
  const told = (await happenings(bytes)).filter((text) => text.startsWith('data:'));
  assert.match(told.join(), /^data:application\/octet-stream;base64.{5,300}\.$/);
  await assert.rejects(new SweepfaceLoader().parseAsync(readFileSync(sample), 'faces/'), /takes bytes and options, no path/);
});

test('a loader asks as it was told, and tells how far it is', {...options, timeout: 10_000}, async () => {
  const {fetch} = globalThis, {SweepfaceLoader} = await import('../sweepface_three.js'), loader = new SweepfaceLoader();
  const far = [];
  let asked;
  globalThis.ProgressEvent ??= class { constructor(type, more) { Object.assign(this, {type}, more); } };
  globalThis.fetch = async (request) => {
    asked = request;
    return new Response(readFileSync(sample));
  };
  try {
    loader.setPath('http://a/faces/').setRequestHeader({authorization: 'me'}).setWithCredentials(true);
    await loader.loadAsync('face.sweep', (event) => far.push(event));
    assert.deepEqual([asked.url, asked.headers.get('authorization'), asked.credentials],
                     ['http://a/faces/face.sweep', 'me', 'include']);
    assert.ok(far.length > 0);
  } finally {
    globalThis.fetch = fetch;
  }
});

test('a load tells the manager that it began with, and has the options of then', {...options, timeout: 10_000}, async () => {
  const {fetch} = globalThis, {SweepfaceLoader} = await import('../sweepface_three.js'), seen = [];
  const managers = ['first', 'second'].map((name) => new three.LoadingManager(() => seen.push(name)));
  globalThis.fetch = async () => new Response(readFileSync(sample));
  try {
    const regions = [{name: 'above', points: [[0, 8, 9]], whole: 5}];
    // Some frameworks wrap in a Proxy what they watch.
    const loader = new SweepfaceLoader(managers[0], {regions: new Proxy(regions, {})});
    const one = loader.loadAsync('http://a/one');
    loader.manager = managers[1];
    loader.options.lod = 2;
    regions[0].name = 'brows';
    const meshes = await Promise.all([one, loader.loadAsync('http://a/two')]);
    assert.deepEqual(meshes.map(({face}) => face.lod), [0, 2]);
    assert.deepEqual(meshes.map(({face}) => face.regions[1]), ['above', 'brows']);
    await new Promise((resolve) => setTimeout(resolve));
    assert.deepEqual(seen.sort(), ['first', 'second']);
    loader.options.regions = [{name: 'a', whole: () => 1}];
    await assert.rejects(loader.loadAsync('http://a/one'), /^TypeError: Region 'a' says nowhere where it is/);
  } finally {
    globalThis.fetch = fetch;
  }
});

test('materials are plain, one a part, named as in the source', options, async () => {
  const mesh = await load();
  assert.deepEqual(mesh.material.map(({name}) => name), mesh.face.parts.map(({material}) => material));
  assert.ok(mesh.material.every((material) => material instanceof three.MeshStandardMaterial));
  assert.ok(mesh.material.every(({side}) => side === three.DoubleSide));
  assert.deepEqual(mesh.geometry.groups,
                   mesh.face.parts.map(({start, count}, materialIndex) => ({start, count, materialIndex})));
});

test('the geometry has texture coordinates and knows its size', options, async () => {
  const mesh = await load();
  assert.equal(mesh.geometry.attributes.uv.count, mesh.face.vertexCount);
  assert.ok(mesh.geometry.boundingSphere.radius > 10);
  const rays = new three.Raycaster(new three.Vector3(0, 0, 100), new three.Vector3(0, 0, -1));
  assert.ok(rays.intersectObject(mesh).length > 0);
});

test('normals are of unit length and point outwards', options, async () => {
  const mesh = await load(), {position, normal} = mesh.geometry.attributes;
  const centre = mesh.geometry.boundingSphere.center, p = new three.Vector3(), n = new three.Vector3();
  let outward = 0;
  for (let v = 0; v < position.count; ++v) {
    n.fromBufferAttribute(normal, v);
    assert.ok(Math.abs(n.length() - 1) < 1e-5);
    outward += n.dot(p.fromBufferAttribute(position, v).sub(centre)) > 0;
  }
  assert.ok(outward > 0.9 * position.count);
});

for (const [name, module] of [['SweepfaceMesh', 'three'], ['SweepfaceGpuMesh', 'gpu']])
  test(`${name} does nothing and meets no ray once it is disposed of`, options, async () => {
    const Made = (await import(`../sweepface_${module}.js`))[name];
    const rays = new three.Raycaster(new three.Vector3(0, 0, 100), new three.Vector3(0, 0, -1));
    for (const moves of [false, true]) {
      const mesh = new Made((await load()).face);
      assert.ok(rays.intersectObject(mesh).length > 0);
      if (moves) mesh.moveTo({jawOpen: 1});
      else mesh.setWeights({jawOpen: 1});
      mesh.dispose();
      for (const seconds of [0, 1 / 60]) mesh.update(seconds);
      assert.deepEqual(rays.intersectObject(mesh), []);
    }
  });

test('a bounding box that was asked for follows the face', options, async () => {
  const mesh = await load(), {geometry} = mesh;
  assert.equal(geometry.boundingBox, null);
  geometry.computeBoundingBox();
  const before = geometry.boundingBox.clone(), {radius} = geometry.boundingSphere;
  mesh.setWeights({jawOpen: 20});
  mesh.update();
  assert.ok(geometry.boundingSphere.radius > 1.1 * radius);
  assert.notDeepEqual(geometry.boundingBox, before);
  assert.deepEqual(geometry.boundingBox, new three.Box3().setFromBufferAttribute(geometry.attributes.position));
});

test('a disposed mesh gives its materials and its face back', options, async () => {
  const mesh = await load(), {material: materials} = mesh;
  let gone = 0;
  for (const material of materials) material.addEventListener('dispose', () => { ++gone; });
  mesh.dispose();
  assert.equal(gone, materials.length);
  assert.throws(() => mesh.face.names, {message: 'The face was disposed of.'});
});

test('clones share materials until the last of them goes', options, async () => {
  const mesh = await load(), twin = mesh.clone(), other = new three.MeshBasicMaterial(), gone = new Set();
  for (const material of [...mesh.material, other]) material.addEventListener('dispose', ({target}) => gone.add(target));
  mesh.dispose();
  mesh.dispose();
  assert.equal(gone.size, 0);
  const last = twin.clone();
  twin.dispose();
  assert.equal(gone.size, 0);
  const {material} = last;
  last.material = other;  // put in by the application, and shown by a clone of the clone
  last.clone().dispose();
  assert.equal(gone.size, 0);
  last.material = material;
  last.dispose();
  assert.deepEqual(gone, new Set(material));
});

/** The vertex that an expression moves farthest. */
function farthest(mesh, weights) {
  const neutral = new Float32Array(3 * mesh.face.vertexCount), moved = neutral.slice();
  mesh.face.evaluate(neutral, null);
  mesh.face.setWeights(weights);
  mesh.face.evaluate(moved, null);
  mesh.face.reset();
  const at = (positions, v) => new three.Vector3().fromArray(positions, 3 * v);
  const distances = Array.from({length: mesh.face.pointCount}, (_, v) => at(neutral, v).distanceTo(at(moved, v)));
  const vertex = distances.indexOf(Math.max(...distances));
  return {vertex, rest: at(neutral, vertex), moved: at(moved, vertex)};
}

for (const kind of ['SweepfaceMesh', 'SweepfaceGpuMesh', 'SweepfaceNodeMesh'])
  test(`a pin follows the skin of a ${kind} and turns with it`, options, async () => {
    const classes = {};
    for (const entry of ['three', 'gpu', 'webgpu']) Object.assign(classes, await import(`../sweepface_${entry}.js`));
    const mesh = await new classes.SweepfaceLoader(undefined, {mesh: classes[kind]}).parseAsync(readFileSync(sample));
    const {rest, moved} = farthest(mesh, {jawOpen: 1}), pin = mesh.pin(rest), near = 1e-5 * rest.length();
    assert.ok(pin.position.distanceTo(rest) < near && pin.quaternion.angleTo(new three.Quaternion()) < 1e-6);
    mesh.position.set(10, 0, 0);
    const glasses = new three.Object3D(), where = () => glasses.getWorldPosition(new three.Vector3());
    glasses.position.copy(rest).add(new three.Vector3(10, 0, 1));
    mesh.updateMatrixWorld();
    pin.attach(glasses);
    assert.ok(where().distanceTo(rest.clone().add(new three.Vector3(10, 0, 1))) < near, 'it stays where it is');
    mesh.setWeights({jawOpen: 1});
    assert.ok(pin.position.distanceTo(rest) < near, 'until it is shown');
    mesh.update();
    assert.ok(pin.position.distanceTo(moved) < near);
    const turn = pin.quaternion.angleTo(new three.Quaternion());
    assert.ok(turn > 0.05, 'a chin turns');
    const offset = new three.Vector3(0, 0, 1).applyQuaternion(pin.quaternion);
    assert.ok(where().distanceTo(moved.clone().add(offset).add(mesh.position)) < near);

    const twin = mesh.clone(), [other] = twin.children;
    assert.ok(other !== pin && other.position.distanceTo(moved) < near && other.children.length === 1);
    twin.reset();
    twin.update();
    assert.ok(other.position.distanceTo(rest) < near && pin.position.distanceTo(moved) < near);
    mesh.remove(pin);
    mesh.reset();
    mesh.update();
    assert.ok(pin.position.distanceTo(moved) < near, 'taken off');
    mesh.add(pin).update();
    assert.ok(pin.position.distanceTo(rest) < near, 'put on again');
    mesh.remove(pin);
    mesh.morphTargetInfluences[mesh.morphTargetDictionary.jawOpen] = 1;
    const late = mesh.add(other).clone();  // with an influence that was set but not shown yet
    assert.ok(late.children.at(-1).position.distanceTo(moved) < near);
    mesh.setWeights({jawOpen: 0});
    mesh.setWeights({jawOpen: 1});
    const low = mesh.pin(moved);  // in the pose that was set, before update() has shown it
    assert.ok(low.position.distanceTo(moved) < near && low.quaternion.angleTo(new three.Quaternion()) < 1e-6);
    for (const odd of [undefined, [0, 0, 0], {x: 0, y: NaN, z: 0}, new three.Vector3(1e160, 0, 0)])
      assert.throws(() => mesh.pin(odd), {message: 'A pin takes a point: a Vector3 in the coordinates of the face.'});
    assert.equal(mesh.children.length, 2);
  });

test('a mesh moves its own pins, also behind a Proxy, and leaves others alone', options, async () => {
  const mesh = await load(), {rest, moved} = farthest(mesh, {jawOpen: 1}), near = 1e-5 * rest.length();
  const {SweepfaceLoader} = await import('../sweepface_three.js');
  const fine = await new SweepfaceLoader(undefined, {lod: 2}).parseAsync(readFileSync(sample));
  const foreign = fine.pin(rest), proxied = new Proxy(mesh.pin(rest), {}), copied = mesh.pin(rest).copy(new three.Object3D());
  mesh.clear();
  mesh.add(foreign, proxied, copied, mesh.pin(rest));
  mesh.setWeights({jawOpen: 1});
  mesh.update();
  assert.ok(mesh.children.at(-1).position.distanceTo(moved) < near && proxied.position.distanceTo(moved) < near);
  assert.ok(foreign.position.distanceTo(rest) < near && copied.position.length() === 0);
  mesh.geometry = new three.BoxGeometry();
  assert.throws(() => mesh.pin(rest), {message: /^The geometry must have the \d+ vertices of the face/});
  fine.dispose();
  fine.update();
  assert.throws(() => fine.pin(rest), Error);
});

test('a pin lies on the nearest triangle', options, async () => {
  const mesh = await load(), {position: {array}} = mesh.geometry.attributes, index = mesh.face.triangles;
  const box = new three.Box3().setFromArray(array), size = box.getSize(new three.Vector3());
  for (let k = 0; k < 5; ++k) {
    const point = box.min.clone().addScaledVector(size, 0.17 * k + 0.1), triangle = new three.Triangle(), place = new three.Vector3();
    let least = Infinity;
    for (let t = 0; t < index.length; t += 3) {
      ['a', 'b', 'c'].forEach((name, c) => triangle[name].fromArray(array, 3 * index[t + c]));
      least = Math.min(least, triangle.closestPointToPoint(point, place).distanceTo(point));
    }
    assert.ok(Math.abs(mesh.pin(point).position.distanceTo(point) - least) < 1e-5 * size.length());
  }
});

test('clips and timelines play on a mesh as well', options, async () => {
  const {ClipPlayer, readClip, readTimeline, TimelinePlayer} = await import('../sweepface_clips.js');
  const mesh = await load(), {position} = mesh.geometry.attributes;
  const player = new ClipPlayer(mesh, readClip('Timecode,JawOpen\n0,0\n1,1'));
  player.seek(0.5);
  mesh.update();
  assert.equal(mesh.face.weights.jawOpen, 0.5);
  const {version} = position;
  const events = [{at: 0.1, to: {jawOpen: 0}, drive: 'cut'}];
  const scene = new TimelinePlayer(mesh, readTimeline(JSON.stringify({seconds: 1, events})));
  assert.equal(scene.advance(0.2), true);
  mesh.update();
  assert.equal(mesh.face.weights.jawOpen, 0);
  assert.ok(position.version > version);
});
