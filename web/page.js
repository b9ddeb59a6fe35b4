// The page: shows a .sweep face and lets its expressions be tried.
import {Sweepface} from 'sweepface';
import {at, complain, say} from './page_message.js';
import {average, buildSliders, filterSliders, followWeights, tellFigures} from './page_panel.js';
import {
  controls, linesOver, meshOf, placeCamera, removeLines, render, resize, scene, stage, view
} from './page_stage.js';

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
    const next = standing(face, mesh && keepView ? mesh.face.weights : {});
    remove();
    bytes = buffer;
    mesh = next;
    scene.add(mesh);
    if (!keepView) placeCamera(mesh);
    say('');
    tellName(name);
    buildSliders(mesh, setWeight);
    drawLines();
    draw(0);
    loading = performance.now() - began;
    tellFigures(figures());
    setTimeout(() => prepare(face), 50);  // once the first frame is on the screen
  } catch (error) {
    if (mine !== asked) return;
    if (mesh) at('lod').value = mesh.face.lod;  // what is still on show
    complain(error);
  }
}

/** A mesh of a face that stands so; a face that cannot is disposed of. */
function standing(face, weights) {
  try {
    const made = meshOf(face);
    made.setWeights(weights);
    return made;
  } catch (error) {
    face.dispose();
    throw error;
  }
}

/** Does what was asked for, or says why it cannot be. */
function attempt(action) {
  try {
    action();
  } catch (error) {
    complain(error);
  }
}

/** Makes a face ready to move, if it is still on show. */
function prepare(face) {
  attempt(() => mesh?.face === face && face.prepare());
}

function invite() {
  say('Drop a .sweep file here, or open one.');
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

function drawLines() {
  if (lines) removeLines(lines);
  lines = at('lines').checked && mesh ? linesOver(mesh) : undefined;
}

function setWeight(name, weight) {
  attempt(() => mesh.setWeights({[name]: weight}));
  wake();
}

function figures() {
  return {file: bytes.byteLength, vertices: mesh.face.vertexCount, loading, memory: mesh.face.memoryBytes};
}

function surprise() {
  const names = mesh.face.names, chosen = names.filter(() => Math.random() < 3 / names.length);
  const goals = Object.fromEntries(names.map((name) => [name, 0]));
  for (const name of chosen.length ? chosen : names.slice(0, 1)) goals[name] = 0.5 + Math.random() / 2;
  mesh.moveTo(goals, {kind: 'spring', frequency: 1.8, damping: 0.6});
  wake();
}

function draw(seconds) {
  const began = performance.now(), version = mesh?.geometry.attributes.position.version;
  mesh?.update(seconds);
  if (mesh && mesh.geometry.attributes.position.version !== version) {
    average('evaluation', performance.now() - began);
    followWeights(mesh);
    wake();
  }
  if (controls.update()) wake();
  render();
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
  attempt(() => {
    draw(Math.min(Math.max(now - last, 0) / 1000, 0.1));
    if (mesh && now - told > 250) {
      tellFigures(figures());
      told = now;
    }
  });
  last = now;
  running = now < awakeUntil;
  if (running) requestAnimationFrame(frame);
}

function fit() {
  resize();
  wake();
}

async function open(file) {
  if (file) await show(file.arrayBuffer(), file.name);
}

/** The bytes behind a URL; of one that nobody asked for, nothing if it is not there. */
async function download(url, isWanted) {
  const response = await fetch(url).catch(() => undefined);
  const whole = response?.ok && await response.arrayBuffer().catch(() => undefined);
  if (whole) return whole;
  const answer = response?.ok ? 'breaks off' : `answers ${response?.status ?? 'nothing'}`;
  if (isWanted) throw new Error(`${url} cannot be had: the server ${answer}.`);
}

at('file').addEventListener('change', ({target}) => {
  open(target.files[0]);
  target.value = '';  // so that the same file, converted again, may be chosen again
});
at('filter').addEventListener('input', filterSliders);
at('surprise').addEventListener('click', () => attempt(() => mesh && surprise()));
at('rest').addEventListener('click', () => {
  attempt(() => mesh?.moveTo(Object.fromEntries(mesh.face.names.map((name) => [name, 0]))));
  wake();
});
at('lod').addEventListener('change', () => bytes && show(bytes, stage.dataset.face, true));
at('lines').addEventListener('change', () => {
  drawLines();
  wake();
});
controls.addEventListener('change', wake);
view.addEventListener('webglcontextrestored', wake);
new ResizeObserver(fit).observe(stage);

// What was said of another file is over once the face on show is used.
for (const type of ['pointerdown', 'keydown']) addEventListener(type, () => mesh && say(''));

for (const type of ['dragover', 'dragleave', 'drop'])
  addEventListener(type, (event) => {
    event.preventDefault();
    document.body.classList.toggle('dropping', type === 'dragover');
    if (type === 'drop') open(event.dataTransfer.files[0]);
  });

fit();
const wanted = new URLSearchParams(location.search).get('face'), start = wanted ?? 'sample.sweep';
await show(download(start, wanted !== null), start.split('/').pop());

/** For the console. */
globalThis.sweepface = {get mesh() { return mesh; }, get loading() { return loading; }, show};
