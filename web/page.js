// The page: shows a .sweep face and lets its expressions be tried.
import {
  BackSide, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, HemisphereLight, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {Sweepface} from 'sweepface';
import {SweepfaceMesh} from 'sweepface/three';

const at = (id) => document.getElementById(id);
const view = at('view'), stage = at('stage'), message = at('message');

const renderer = makeRenderer();
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
const scene = new Scene(), camera = new PerspectiveCamera(26, 1, 0.1, 1000);
const controls = new OrbitControls(camera, view);
controls.enableDamping = true;
controls.enablePan = false;

// A large soft light, a key from the upper left and a rim from behind; they stay with the viewer.
const key = new DirectionalLight(0xfff1e2, 2.4), rim = new DirectionalLight(0xbfd4ff, 1.6);
key.position.set(-1, 1.2, 1.6);
rim.position.set(1.4, 0.6, -1.5);
scene.add(new HemisphereLight(0xffffff, 0x8a7668, 1.3), camera);
camera.add(key, key.target, rim, rim.target);

function makeRenderer() {
  try {
    return new WebGLRenderer({canvas: view, antialias: true, alpha: true});
  } catch (error) {
    complain(new Error('Faces are drawn with WebGL 2, which this browser or its settings do not offer.'));
    throw error;
  }
}

/** What is seen of a head's inside, through eyes and mouth; and its edges. */
const inside = new MeshBasicMaterial({color: 0x2b1a14, side: BackSide});
const ink = new LineBasicMaterial({color: 0x5a2c14, transparent: true, opacity: 0.35});

/** A colour for a material, by what its name says. */
function colourOf(name) {
  const known = [[/lip|mouth|tongue|gum/i, 0xb8675c], [/teeth|tooth/i, 0xf0e8d8], [/lash|brow|hair|beard/i, 0x3a2a22],
                 [/iris/i, 0x61757f], [/pupil/i, 0x1f1c1c], [/nostril/i, 0x734539], [/eye|sclera|cornea/i, 0xf4f1ee]];
  return new Color(known.find(([pattern]) => pattern.test(name))?.[1] ?? 0xd9a688);
}

let bytes, mesh, lines;  // the file, the face on show and, if wanted, its edges
let loading = 0;         // milliseconds from the bytes to the first frame
let asked = 0;           // how often a file was asked for; the last is shown, whichever is there first

/** Shows a file, from its bytes or what will be its bytes, or says why it cannot be. */
async function show(source, name, keepView = false) {
  const mine = ++asked;
  try {
    const buffer = await source;
    if (mine !== asked) return;
    if (!buffer) return invite();
    const began = performance.now();
    const face = await Sweepface.load(buffer, {name, lod: Number(at('lod').value)});
    if (mine !== asked) return face.dispose();
    const weights = mesh && keepView ? mesh.face.weights : {};
    remove();
    bytes = buffer;
    mesh = new SweepfaceMesh(face, face.parts.map(({material}) =>
      new MeshStandardMaterial({name: material, color: colourOf(material), roughness: 0.62})));
    mesh.add(new Mesh(mesh.geometry, inside));
    mesh.setWeights(weights);
    scene.add(mesh);
    if (!keepView) placeCamera();
    message.textContent = '';
    message.className = '';
    tellName(name);
    buildSliders();
    drawLines();
    draw(0);
    loading = performance.now() - began;
    tellFigures();
    setTimeout(() => prepare(face), 50);  // once the first frame is on the screen
  } catch (error) {
    if (mine === asked) complain(error);
  }
}

/** Makes a face ready to move, if it is still on show. */
function prepare(face) {
  try {
    if (mesh?.face === face) face.prepare();
  } catch (error) {
    complain(error);
  }
}

function complain(error) {
  message.textContent = error.message;
  message.className = 'error';
}

function invite() {
  message.textContent = 'Drop a .sweep file here, or open one.';
}

function tellName(name) {
  document.title = `${name} · Sweepface`;
  stage.dataset.face = name;
}

function remove() {
  if (!mesh) return;
  scene.remove(mesh);
  mesh.dispose();
  mesh = undefined;
}

/** The camera in front of the face, at a distance from which all of it is seen. */
function placeCamera() {
  const box = new Box3().setFromBufferAttribute(mesh.geometry.attributes.position);
  const size = box.getSize(new Vector3()), middle = box.getCenter(new Vector3());
  const reach = Math.max(size.y, size.x / camera.aspect) / 2 / Math.tan(camera.fov / 2 * Math.PI / 180);
  const distance = 1.15 * reach + size.z / 2;
  controls.target.copy(middle);
  camera.position.copy(middle).add(new Vector3(0.25, 0.06, 1).setLength(distance));
  camera.near = distance / 100;
  camera.far = 10 * distance;
  camera.updateProjectionMatrix();
  controls.minDistance = distance / 6;
  controls.maxDistance = 3 * distance;
  controls.update();
}

/** The edges of the triangles, drawn over the face. */
function drawLines() {
  if (lines) {
    lines.removeFromParent();
    lines.geometry.deleteAttribute('position').dispose();  // the positions are the face's
    lines = undefined;
  }
  if (!at('lines').checked || !mesh) return;
  const edges = new BufferGeometry();  // over the positions of the face, which they follow
  const {index, attributes: {position}} = mesh.geometry;
  edges.setIndex(new BufferAttribute(edgesOf(index.array, position.count), 1));
  edges.setAttribute('position', position);
  lines = new LineSegments(edges, ink);
  lines.frustumCulled = false;  // bounds would be those of how the face stands now
  mesh.add(lines);
}

/** The edges of triangles among `count` vertices, each once, as two of them. */
function edgesOf(triangles, count) {
  const edges = new Set();
  for (let first = 0; first < triangles.length; first += 3)
    for (let k = 0; k < 3; ++k) {
      const a = triangles[first + k], b = triangles[first + (k + 1) % 3];
      edges.add(Math.min(a, b) * count + Math.max(a, b));
    }
  const ends = new Uint32Array(2 * edges.size);
  let end = 0;
  for (const edge of edges) {
    ends[end++] = Math.floor(edge / count);
    ends[end++] = edge % count;
  }
  return ends;
}

const sliders = new Map();  // by name: the input and what shows its number

function buildSliders() {
  sliders.clear();
  at('sliders').replaceChildren(...mesh.face.names.map((name) => {
    const row = document.createElement('label'), text = document.createElement('span');
    const number = document.createElement('span'), input = document.createElement('input');
    row.className = 'slider';
    text.textContent = name;
    number.className = 'number';
    number.ariaHidden = 'true';  // the slider says it, and its name is the text alone
    Object.assign(input, {type: 'range', min: 0, max: 1, step: 0.01, name});
    input.addEventListener('input', () => {
      mesh.setWeights({[name]: input.valueAsNumber});
      number.textContent = input.valueAsNumber.toFixed(2);
      wake();
    });
    row.append(text, number, input);
    sliders.set(name, {row, input, number});
    return row;
  }));
  followWeights();
  filterSliders();
}

function followWeights() {
  for (const [name, weight] of Object.entries(mesh.face.weights)) {
    const {input, number} = sliders.get(name);
    if (document.activeElement !== input || number.textContent === '') input.value = weight;
    number.textContent = weight.toFixed(2);
  }
}

function filterSliders() {
  const wanted = at('filter').value.trim().toLowerCase();
  for (const [name, {row}] of sliders) row.hidden = !name.toLowerCase().includes(wanted);
}

function surprise() {
  const names = mesh.face.names, chosen = names.filter(() => Math.random() < 3 / names.length);
  const goals = Object.fromEntries(names.map((name) => [name, 0]));
  for (const name of chosen.length ? chosen : names.slice(0, 1)) goals[name] = 0.5 + Math.random() / 2;
  mesh.moveTo(goals, {kind: 'spring', frequency: 1.8, damping: 0.6});
  wake();
}

const megabytes = (size) => `${(size / 1e6).toFixed(size < 1e6 ? 2 : 1)} MB`;
const figures = {};  // smoothed milliseconds

function tellFigures() {
  const rows = {
    'file': megabytes(bytes.byteLength), 'vertices': mesh.face.vertexCount.toLocaleString('en'),
    'loaded in': `${loading.toFixed(0)} ms`, 'evaluation': `${(figures.evaluation ?? 0).toFixed(2)} ms`,
    'frame': `${(figures.frame ?? 0).toFixed(1)} ms`, 'memory': megabytes(mesh.face.memoryBytes),
  };
  at('figures').replaceChildren(...Object.entries(rows).flatMap(([name, value]) => {
    const term = document.createElement('dt'), text = document.createElement('dd');
    term.textContent = name;
    text.textContent = value;
    return [term, text];
  }));
}

function average(name, value) {
  figures[name] = figures[name] === undefined ? value : 0.9 * figures[name] + 0.1 * value;
}

function resize() {
  const {clientWidth, clientHeight} = stage;
  renderer.setSize(clientWidth, clientHeight, false);
  camera.aspect = clientWidth / Math.max(clientHeight, 1);
  camera.updateProjectionMatrix();
  wake();
}

function draw(seconds) {
  const began = performance.now(), version = mesh?.geometry.attributes.position.version;
  mesh?.update(seconds);
  if (mesh && mesh.geometry.attributes.position.version !== version) {
    average('evaluation', performance.now() - began);
    followWeights();
    wake();
  }
  if (controls.update()) wake();
  renderer.render(scene, camera);
  average('frame', performance.now() - began);
}

// Frames are drawn as long as something moves, and a little longer.
let awakeUntil = 0, last = 0, told = 0, running = false;
function wake() {
  awakeUntil = performance.now() + 500;
  if (running) return;
  running = true;
  last = performance.now();
  requestAnimationFrame(frame);
}

function frame(now) {
  draw(Math.min(Math.max(now - last, 0) / 1000, 0.1));
  last = now;
  if (mesh && now - told > 250) {
    tellFigures();
    told = now;
  }
  running = now < awakeUntil;
  if (running) requestAnimationFrame(frame);
}

async function open(file) {
  if (file) await show(file.arrayBuffer(), file.name);
}

/** The bytes behind a URL; of one that nobody asked for, nothing if it is not there. */
async function download(url, isWanted) {
  const response = await fetch(url).catch(() => undefined);
  if (response?.ok) return response.arrayBuffer();
  if (isWanted) throw new Error(`${url} cannot be had: the server answers ${response?.status ?? 'nothing'}.`);
}

at('file').addEventListener('change', ({target}) => {
  open(target.files[0]);
  target.value = '';  // so that the same file, converted again, may be chosen again
});
at('filter').addEventListener('input', filterSliders);
at('surprise').addEventListener('click', () => mesh && surprise());
at('rest').addEventListener('click', () => {
  if (mesh) mesh.moveTo(Object.fromEntries(mesh.face.names.map((name) => [name, 0])));
  wake();
});
at('lod').addEventListener('change', () => bytes && show(bytes, stage.dataset.face, true));
at('lines').addEventListener('change', () => {
  drawLines();
  wake();
});
controls.addEventListener('change', wake);
view.addEventListener('webglcontextrestored', wake);
new ResizeObserver(resize).observe(stage);

for (const type of ['dragover', 'dragleave', 'drop'])
  addEventListener(type, (event) => {
    event.preventDefault();
    document.body.classList.toggle('dropping', type === 'dragover');
    if (type === 'drop') open(event.dataTransfer.files[0]);
  });

resize();
const wanted = new URLSearchParams(location.search).get('face'), start = wanted ?? 'sample.sweep';
await show(download(start, wanted !== null), start.split('/').pop());

/** For the console. */
globalThis.sweepface = {get mesh() { return mesh; }, get loading() { return loading; }, show};
