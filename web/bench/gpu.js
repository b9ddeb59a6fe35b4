// Measures how long a frame takes when a face is drawn by three.js's own morph targets, by SweepfaceMesh, which is
// evaluated on the CPU, and by the vertex shader of SweepfaceGpuMesh. Every weight changes every frame.
//
//   npm ci && node bench/gpu.js FACE.sweep [HEADS...]
//
// SWEEPFACE_CHROMIUM_ARGS are the switches that let the browser use a graphics card; on Linux with NVIDIA's driver
// "--use-gl=angle --use-angle=gl-egl --ignore-gpu-blocklist --enable-gpu". Without a graphics card the figures are
// those of software rendering, which prove nothing.
import {readFileSync} from 'node:fs';
import {blank, withPage} from '../test/browser.js';

const [file, ...heads] = process.argv.slice(2);
if (!file) {
  console.error('Usage: node bench/gpu.js FACE.sweep [HEADS...]');
  process.exit(2);
}
const counts = heads.length ? heads.map(Number) : [1, 16];
const files = {'blank.html': blank, 'face.sweep': readFileSync(file)};

/** Runs in the page. Returns the graphics card, and milliseconds a frame for each way of drawing. */
async function measure(counts) {
  const THREE = await import('three');
  const {Sweepface} = await import('/sweepface.js'), {SweepfaceMesh} = await import('/sweepface_three.js');
  const {SweepfaceGpuMesh} = await import('/sweepface_gpu.js'), {morphMesh} = await import('/test/morph_mesh.js');
  const bytes = await (await fetch('/face.sweep')).arrayBuffer();
  const load = () => Sweepface.load(bytes.slice(0)), frames = 200, size = 512;

  const renderer = new THREE.WebGLRenderer({canvas: new OffscreenCanvas(size, size), antialias: false});
  const gl = renderer.getContext(), timer = gl.getExtension('EXT_disjoint_timer_query_webgl2');
  const about = gl.getExtension('WEBGL_debug_renderer_info');
  const target = new THREE.WebGLRenderTarget(size, size), pixel = new Uint8Array(4);
  const first = new SweepfaceMesh(await load()), names = first.names;
  const {center, radius} = (first.geometry.computeBoundingSphere(), first.geometry.boundingSphere.clone());
  const camera = new THREE.PerspectiveCamera(30, 1, radius, 9 * radius);
  camera.position.copy(center).add(new THREE.Vector3(0, 0, 4.2 * radius));
  const original = morphMesh(first.face, first.geometry, first.material);

  const ways = {
    'morph targets': () => {
      const mesh = new THREE.Mesh(original.geometry, original.material);
      mesh.morphTargetInfluences = names.map(() => 0);
      return {mesh, pose: (weights) => names.forEach((name, k) => mesh.morphTargetInfluences[k] = weights[name])};
    },
    SweepfaceMesh: async () => follow(new SweepfaceMesh(await load())),
    SweepfaceGpuMesh: async () => follow(new SweepfaceGpuMesh(await load()))
  };
  const follow = (mesh) => ({
    mesh, pose(weights) {
      mesh.setWeights(weights);
      mesh.update();
    }
  });
  const poses = Array.from({length: 16}, (_, p) =>
    Object.fromEntries(names.map((name, k) => [name, 0.02 + ((7 * k + 3 * p) % 10) / 30])));

  /** Milliseconds a frame: in the script, in all, and as the card itself measures. */
  const run = async (actors, scene) => {
    const queries = [];
    const frame = (k, timed) => {
      actors.forEach(({pose}, n) => pose(poses[(k + n) % poses.length]));
      const query = timed && timer && gl.createQuery();
      if (query) gl.beginQuery(timer.TIME_ELAPSED_EXT, query);
      renderer.setRenderTarget(target);
      renderer.render(scene, camera);
      if (query) gl.endQuery(timer.TIME_ELAPSED_EXT), queries.push(query);
    };
    const finish = () => renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
    for (let k = 0; k < 20; ++k) frame(k, false);
    finish();
    const start = performance.now();
    for (let k = 0; k < frames; ++k) frame(k, false);
    const script = performance.now() - start;
    finish();
    const whole = performance.now() - start;
    for (let k = 0; k < 50; ++k) frame(k, true);
    finish();
    await new Promise((ready) => setTimeout(ready, 200));
    const told = queries.filter((q) => gl.getQueryParameter(q, gl.QUERY_RESULT_AVAILABLE))
      .map((q) => gl.getQueryParameter(q, gl.QUERY_RESULT) / 1e6).sort((a, b) => a - b);
    return {script: script / frames, whole: whole / frames, card: told[told.length >> 1]};
  };

  const rows = [];
  for (const count of counts) {
    for (const [way, make] of Object.entries(ways)) {
      const actors = [], scene = new THREE.Scene();
      for (let n = 0; n < count; ++n) actors.push(await make());
      scene.add(new THREE.AmbientLight(0xffffff, 1), ...actors.map(({mesh}) => mesh));
      rows.push({way, count, ...await run(actors, scene)});
      for (const {mesh} of actors) mesh.face?.dispose();
    }
  }
  return {card: gl.getParameter(about ? about.UNMASKED_RENDERER_WEBGL : gl.RENDERER), vertices: first.face.vertexCount,
          targets: names.length, rows};
}

const {card, vertices, targets, rows} = await withPage('blank.html', {files}, (page) => page.evaluate(measure, counts));
console.log(`${card}; ${vertices} vertices, ${targets} targets, all weights change every frame`);
console.log('milliseconds a frame   heads   script    whole   on the card');
for (const {way, count, script, whole, card} of rows)
  console.log(way.padEnd(20), String(count).padStart(7), ...[script, whole].map((x) => x.toFixed(3).padStart(8)),
              (card?.toFixed(3) ?? 'not told').padStart(13));
