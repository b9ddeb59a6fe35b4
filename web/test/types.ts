// Compiles if the types say what the package offers. Never run.
import {AnimationMixer, type Material, MeshBasicMaterial, type Object3D, Scene, Vector3} from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import type {Scene as BabylonScene} from '@babylonjs/core/scene.js';
import {StandardMaterial} from '@babylonjs/core/Materials/standardMaterial.js';
import {SweepfaceMesh as BabylonMesh} from 'sweepface/babylon';
import {importScene, SceneFace as BabylonFace} from 'sweepface/babylon-scene';
import {Sweepface, type Drive, type LoadOptions, type Part, type Pose, type Region, type Weights} from 'sweepface';
import {Clip, ClipPlayer, type OneEuro, readClip, readTimeline, TimelinePlayer} from 'sweepface/clips';
import {SWEEPFACE_GLSL, SweepfaceGpuMesh} from 'sweepface/gpu';
import {cloneScene, SceneFace, type SweepfaceScene, SweepfaceSceneLoader} from 'sweepface/scene';
import {loadInWorker} from 'sweepface/worker';
import {SweepfaceNodeMesh} from 'sweepface/webgpu';
import {animationFor, SweepfaceLoader, SweepfaceMesh} from 'sweepface/three';

export async function useFace(bytes: ArrayBuffer | Uint8Array): Promise<void> {
  const wasm = new URL('https://example.org/a.wasm');
  const face: Sweepface = await Sweepface.load(bytes, {lod: 2, name: 'face.sweep', wasm});
  const positions = new Float32Array(3 * face.vertexCount), parts: Part[] = face.parts;
  face.setWeights({jawOpen: 0.7});
  const drive: Drive = {kind: 'spring', frequency: 3, damping: 0.5, delay: 0.1};
  face.moveTo({jawOpen: 0}, drive);
  face.moveTo({jawOpen: 0}, 'accelerate-brake');
  face.push('jawOpen', 2);
  const moving: boolean = face.advance(1 / 60);
  face.evaluate(positions);
  face.evaluate(null, positions);
  console.log(face.names[0], face.weights.jawOpen, face.weightValues[0], parts[0].material, face.texcoords?.length, face.memoryBytes, moving);
  // @ts-expect-error There is no such drive.
  face.moveTo({jawOpen: 0}, 'jump');
  // @ts-expect-error Faces are made by load.
  new Sweepface();
  face.clone().dispose();
}

export async function useThree(scene: Scene): Promise<void> {
  const mesh: SweepfaceMesh = await new SweepfaceLoader(undefined, {lod: 1}).loadAsync('face.sweep');
  scene.add(mesh);
  mesh.setWeights({jawOpen: 0.7});
  mesh.reset();
  mesh.moveTo({jawOpen: 0}, 'spring');
  const isToDraw: boolean = mesh.update(1 / 60);
  // @ts-expect-error Weights are set by setWeights.
  mesh.weights.jawOpen = isToDraw ? 1 : 0;
  const twin: SweepfaceMesh = mesh.clone();
  mesh.material.find(({name}) => name === 'skin')?.color.set(0xe8b89a);
  const other: SweepfaceMesh<Material | Material[]> = mesh;
  other.material = new MeshBasicMaterial();
  mesh.prepare();
  const pin: Object3D = mesh.pin(new Vector3(0, 1, 2)).attach(scene);
  // @ts-expect-error That is no point.
  pin.add(mesh.pin([0, 1, 2]));
  console.log(animationFor(mesh, {scene, animations: []}).tracks.length);
  mesh.morphTargetInfluences[mesh.morphTargetDictionary.jawOpen ?? 0] = 0.5;
  console.log(new SweepfaceMesh(mesh.face, new MeshBasicMaterial()).material.color, mesh.weights.jawOpen, mesh.pose);
  console.log(twin.regions.length, new SweepfaceLoader(undefined, {wasm: {href: 'a.wasm'}}).abort().options);
  mesh.dispose();
}

export class MyBabylonMesh extends BabylonMesh {
  constructor(name: string, scene: BabylonScene, face: Sweepface) { super(name, scene, face, new StandardMaterial('mine', scene)); }
}

export async function useBabylon(scene: BabylonScene, bytes: ArrayBuffer): Promise<void> {
  const mesh: BabylonMesh = await BabylonMesh.load('face.sweep', scene, {lod: 1, load: loadInWorker});
  mesh.setWeights({jawOpen: 0.7});
  mesh.moveTo({jawOpen: 0}, {kind: 'spring', frequency: 3});
  mesh.position.x = 3;
  const twin: BabylonMesh = mesh.clone('twin'), moving: boolean = twin.advance(0.1);
  const own: MyBabylonMesh = await MyBabylonMesh.load(bytes), last: BabylonMesh = new BabylonMesh('last', null, own.face);
  console.log(last.getScene() === scene, (await BabylonMesh.load(bytes, undefined, {lod: 1})).pose);
  // @ts-expect-error A face is no scene.
  new BabylonMesh('none', mesh.face, mesh.face);
  console.log(moving, mesh.weights.jawOpen, mesh.face.tolerance, new ClipPlayer(mesh, readClip('')).match.undriven);
  mesh.clone('bald', null, true).clone('last', twin);
  new BabylonMesh('other', scene, await Sweepface.load(bytes), new StandardMaterial('skin', scene)).dispose();
  // @ts-expect-error A mesh is made of a face.
  new BabylonMesh('none', scene, bytes);
}

export async function useBabylonScene(scene: BabylonScene, bytes: ArrayBuffer): Promise<void> {
  const {face, meshes, skeletons, animationGroups: [idle], container} = await importScene('avatar.sweep', scene, {
    name: 'Anna', load: loadInWorker, pluginOptions: {gltf: {animationStartMode: 0}}
  });
  const made: BabylonFace = face, moving: boolean = made.advance(0.1);
  made.moveTo({jawOpen: 0.7}, {kind: 'spring', frequency: 3});
  made.advancesWithScene = false;
  idle?.start(true);
  console.log(moving, made.meshes[0]?.morphTargetManager, made instanceof BabylonFace, meshes.length, skeletons.length, container.scene === scene);
  console.log(new ClipPlayer(made, readClip('')).match.undriven, (await importScene(bytes)).face.pose);
  // @ts-expect-error The meshes of a scene have the vertices of their source.
  await importScene(bytes, scene, {lod: 2});
  made.dispose();
}

export async function onTheCard(bytes: ArrayBuffer): Promise<number> {
  const mesh = new SweepfaceGpuMesh(await Sweepface.load(bytes, {vertices: 5000}));
  mesh.prepare();
  mesh.setWeights({jawOpen: 0.5});
  mesh.update(1 / 60);
  const nodes: SweepfaceNodeMesh<MeshBasicMaterial> = new SweepfaceNodeMesh(mesh.face, new MeshBasicMaterial()).clone();
  const loader = new SweepfaceLoader(undefined, {mesh: SweepfaceGpuMesh, lod: 1}), loaded: SweepfaceGpuMesh = await loader.parseAsync(bytes);
  loader.options.mesh = undefined;
  loader.options.load = loadInWorker;
  console.log((await loadInWorker(bytes, {lod: 2})).names, new SweepfaceSceneLoader(undefined, {load: loadInWorker}).options);
  // @ts-expect-error That is no mesh of a face.
  new SweepfaceLoader(undefined, {mesh: Scene});
  return loaded.textureBytes + mesh.frameBytes + SWEEPFACE_GLSL.length + nodes.textureBytes;
}

export async function useScene(scene: Scene, bytes: ArrayBuffer): Promise<SceneFace> {
  const loader = new SweepfaceSceneLoader(undefined, {eyes: true, gltfLoader: new GLTFLoader()}).setPath('models/');
  const model: SweepfaceScene = await loader.loadAsync('avatar.sweep'), {face, animations} = model;
  scene.add(model.scene);
  new AnimationMixer(model.scene).clipAction(animations[0]!).play();
  face.moveTo({jawOpen: 0.7}, 'spring');
  console.log(face.update(1 / 60), face.meshes[0]?.morphTargetInfluences, face.face.tolerance, new ClipPlayer(face, readClip('')).match);
  const twin = cloneScene(model), another: SceneFace = cloneScene(twin).face;
  scene.add(twin.scene);
  another.setWeights(twin.face.weights);
  for (const mesh of [SweepfaceMesh, SweepfaceGpuMesh, SweepfaceNodeMesh]) await loader.parseAsync(bytes, {mesh});
  // @ts-expect-error That is no mesh of a face.
  await loader.parseAsync(bytes, {mesh: Scene});
  // @ts-expect-error A scene has the vertices of its source.
  await loader.parseAsync(bytes, {lod: 2});
  // @ts-expect-error Loaders make it.
  new SceneFace();
  face.dispose();
  return (await loader.abort().parseAsync(bytes, {combine: true})).face;
}

/** A mesh of one's own, as loaders make it. */
export class Mine extends SweepfaceMesh {
  override advance(seconds: number): boolean { return super.advance(2 * seconds); }
  override setWeights(weights: Weights, region?: string): void { super.setWeights(weights, region); }
}

export async function useClips(bytes: ArrayBuffer, csv: string): Promise<void> {
  const timeline = readTimeline(csv), clip: Clip = readClip(csv, {framesPerSecond: 30}).smooth();
  const smooth: Float64Array = readClip(csv).smooth().weights;
  const places = [[1, 2, 3]] as const;
  const cheeks: Region = {name: 'cheeks', points: places, fade: 3, over: 'space', mass: 4};
  const face = await Sweepface.load(bytes, {regions: timeline.regions ?? [cheeks], eyes: true});
  if (face.eyeCount > 0) face.look({leftEye: {yaw: 0.1}});
  face.look(null);
  const player = new ClipPlayer(face, clip), head = player.seek(0.5);
  console.log(clip.renamed({jawOpen: 'mouth-open', puff: ['a', 'b'], smile: {c: 0.5}, tongueOut: null}).names);
  // @ts-expect-error A target is a name.
  clip.renamed({jawOpen: 1});
  const single = new Clip(['jawOpen'], new Float32Array(2), new Float32Array(2));
  new ClipPlayer(new SweepfaceMesh(face), single).face.update();
  const few: Float32Array = clip.at(0.5, new Float32Array(clip.names.length)), all: Float64Array = clip.at(0.5);
  face.moveTo({jawOpen: 1}, {seconds: 1}, face.regions[0]);
  face.setWeights(face.weightsIn('cheeks'), 'cheeks');
  console.log(smooth, few, all, player.match.unmatched, head?.yaw, new TimelinePlayer(face, timeline).advance(0.1));
}

export function withoutSaying(csv: string, seconds: number | undefined): [Drive, LoadOptions, Pose, Region] {
  const settings: OneEuro = {cutoff: undefined, speedGain: undefined, speedCutoff: undefined};
  readClip(csv, {name: undefined, framesPerSecond: undefined}).smooth(settings);
  readTimeline(csv, {name: undefined});
  const nowhere = {parts: undefined, points: undefined, line: undefined, curves: undefined, nodes: undefined};
  const matter = {mass: undefined, stiffness: undefined, delay: seconds};
  const region = {...nowhere, ...matter, whole: undefined, fade: undefined, over: undefined, bands: undefined};
  const pose = {leftEye: {yaw: undefined, pitch: undefined}, rightEye: undefined};
  return [{seconds}, {lod: undefined, name: undefined}, pose, {name: 'cheeks', ...region}];
}
