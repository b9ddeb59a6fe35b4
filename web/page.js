// The page: shows a .sweep face, with sliders to try its expressions.
import {faceOf, offerFile, stopConverting} from './page_convert.js';
import {at, complain, dismiss, hush, say} from './page_message.js';
import {average, buildSliders, filterSliders, followWeights, tellFigures} from './page_panel.js';
import {
  controls, hasScene, isLost, linesOver, loadAlone, loadScene, placeCamera, removeLines, render, resize, scene,
  stage, view
} from './page_stage.js';
import {advanceTake, offerTakes, playTake} from './page_takes.js';

const LOST = 'The graphics card is not available to this page; if it does not come back, reload the page.';

let model, mesh, lines;    // what is on show, what in it moves the face and, if wanted, the face's edges
let file, latest;          // the file on show and the file requested last: its bytes or a promise of them, its name
                           // and, until it is shown, the request `before` it
let loading = 0;           // milliseconds from the bytes to the first frame
let asked = 0, shown = 0;  // the number of requests so far, and which of them is on show
let waiting = 0;           // requests under way
let aim = [{}];            // where the face on show goes: the arguments of moveTo()

/**
 * Shows a file, given its bytes or a promise of them, or reports why it cannot. Of several requests the last one that
 * succeeds is shown, in whatever order they arrive.
 */
async function show(source, name, keepView = false) {
  const mine = ++asked;
  const own = latest = {source, name, before: latest};
  ++waiting;
  say('Loading…');
  try {
    const buffer = await source;
    if (mine < shown) return;
    if (!buffer) return mine === asked && invite();
    if (mesh) await painted();
    const began = performance.now();
    const mayHaveScene = await hasScene(buffer, name);
    const next = await read(buffer, name, mayHaveScene);
    if (mine < shown) return next.mover.dispose();
    stand(next.mover, mesh && keepView ? mesh.face.weights : {});
    remove();
    shown = mine;
    if (mine === asked) stopConverting();
    file = Object.assign(own, {source: buffer, before: undefined});
    model = next;
    mesh = model.mover;
    scene.add(model.object);
    offer(mayHaveScene);
    if (keepView) {
      mesh.moveTo(...aim);
    } else {
      aim = [{}];
      placeCamera(model.meshes);
    }
    document.title = `${name} · Sweepface`;
    offerFile(buffer, name);
    buildSliders(mesh, setWeight);
    drawLines();
    draw(0);
    loading = performance.now() - began;
    tellFigures(figures());
    setTimeout(() => prepare(next.mover), 50);  // once the first frame is on the screen
    wake();
  } catch (error) {
    if (mine === asked) complain(error);
  } finally {
    own.isOver = file !== own;
    while (latest?.isOver) latest = latest.before;
    if (--waiting === 0 && mesh) {
      hush(isLost() ? LOST : '');
      at('lod').value = mesh.face.lod;
    }
  }
}

/** Resolves once the page's message is on the screen. */
const painted = () => new Promise((done) => { setTimeout(done, 50); });

/** What a file shows: the face with all that it came with, if that is wanted and can be shown, or alone. */
async function read(buffer, name, mayHaveScene) {
  try {
    if (mayHaveScene && at('scene').checked) return await loadScene(buffer, {name});
  } catch (error) {
    at('scene').checked = false;
    complain(error);
  }
  return loadAlone(buffer, {name, lod: Number(at('lod').value)});
}

/** Gives a new face these weights; disposes of it if that fails. */
function stand(mover, weights) {
  try {
    mover.setWeights(weights);
  } catch (error) {
    mover.dispose();
    throw error;
  }
}

/** Offers what can be chosen of the face on show: a scene has neither levels of detail nor lines, but may be animated. */
function offer(mayHaveScene) {
  const inScene = model.object !== mesh;
  at('choice').hidden = !mayHaveScene;
  at('lod').disabled = at('lines').disabled = at('lines').parentElement.hidden = inScene;
  offerTakes(model);
}

/** Runs an action, and reports its error if it fails. */
function attempt(action) {
  try {
    action();
  } catch (error) {
    complain(error);
  }
}

/** Prepares a face to move, if it is still on show. */
function prepare(mover) {
  attempt(() => mesh === mover && mover.prepare());
}

function invite() {
  say('Drop a .sweep, .glb or .vrm file here, or open one.');
}

function remove() {
  if (!mesh) return;
  model.object.removeFromParent();
  mesh.dispose();
  model = mesh = undefined;
}

function drawLines() {
  if (lines) removeLines(lines);
  lines = at('lines').checked && !at('lines').disabled && mesh ? linesOver(mesh) : undefined;
}

function setWeight(name, weight) {
  aim[0][name] = weight;
  attempt(() => mesh.setWeights({[name]: weight}));
  wake();
}

/** Moves the face by a spring, or at once for users who prefer reduced motion. */
function moveTo(goals, spring) {
  const cut = matchMedia('(prefers-reduced-motion: reduce)').matches;
  aim = [goals, cut ? {kind: 'cut'} : {kind: 'spring', ...spring}];
  mesh.moveTo(...aim);
  wake();
}

const still = () => Object.fromEntries(mesh.face.names.map((name) => [name, 0]));

function figures() {
  return {file: file.source.byteLength, vertices: mesh.face.vertexCount, loading, memory: mesh.face.memoryBytes};
}

function surprise() {
  const names = mesh.face.names, chosen = names.filter(() => Math.random() < 3 / names.length), goals = still();
  for (const name of chosen.length ? chosen : names.slice(0, 1)) goals[name] = 0.5 + Math.random() / 2;
  moveTo(goals, {frequency: 1.8, damping: 0.6});
}

function draw(seconds) {
  const began = performance.now(), versionOf = () => model?.meshes[0].geometry.attributes.position.version;
  const version = versionOf();
  if (advanceTake(seconds)) wake();
  mesh?.update(seconds);
  if (versionOf() !== version) {
    average('evaluation', performance.now() - began);
    followWeights(mesh);
    wake();
  }
  if (controls.update()) wake();
  render();
  average('frame', performance.now() - began);
}

// Frames are drawn while something moves, and a little longer.
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

/** Keeps the picture sharp when the pixel density changes. */
function watchDensity() {
  const same = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
  same.addEventListener('change', () => {
    fit();
    watchDensity();
  }, {once: true});
}

/** Shows a file, or the face that it is converted into. */
const showFile = (source, name) => show(faceOf(source, name), name);

/** Opens the first of several files that is named as a face, or else the first of all. */
async function open(files) {
  const isNamedAsFace = ({name}) => name.toLowerCase().endsWith('.sweep');
  const [file] = [...files].sort((a, b) => isNamedAsFace(b) - isNamedAsFace(a));
  if (file) await showFile(bytesOf(file), file.name);
}

async function bytesOf(file) {
  try {
    return await file.arrayBuffer();
  } catch (error) {
    const advice = file.size > 1e9 ? 'it is too large for this browser' : 'it may have been moved; choose it again';
    throw new Error(`${file.name} cannot be read; ${advice}.`, {cause: error});
  }
}

/** The bytes at a URL. If they cannot be had, throws if somebody asked for them, or else returns nothing. */
async function download(url, isWanted) {
  const response = await fetch(url).catch(() => undefined);
  const whole = response?.ok && await response.arrayBuffer().catch(() => undefined);
  if (whole) return whole;
  const answer = response?.ok ? 'breaks off' : `answers ${response?.status ?? 'nothing'}`;
  if (isWanted) throw new Error(`${url} cannot be had: the server ${answer}.`);
}

at('file').addEventListener('change', ({target}) => {
  open(target.files);
  target.value = '';  // so that the same file, converted again, may be chosen again
});
at('filter').addEventListener('input', filterSliders);
at('surprise').addEventListener('click', () => attempt(() => mesh && surprise()));
at('rest').addEventListener('click', () => {
  attempt(() => mesh && moveTo(still()));
});
for (const id of ['lod', 'scene'])
  at(id).addEventListener('change', () => latest && show(latest.source, latest.name, latest.source === file?.source));
at('take').addEventListener('change', () => {
  playTake();
  wake();
});
at('lines').addEventListener('change', () => {
  drawLines();
  wake();
});
controls.addEventListener('change', wake);
view.addEventListener('webglcontextlost', () => complain(new Error(LOST)));
view.addEventListener('webglcontextrestored', () => {
  dismiss(LOST);
  wake();
});
new ResizeObserver(fit).observe(stage);
watchDensity();

// An error about another file is dismissed once the face on show is used. While no face can be seen, errors stay.
const PASSING = ['Tab', 'Shift', 'Control', 'Alt', 'AltGraph', 'Meta', 'CapsLock'];
const isSeen = () => mesh && !isLost();
addEventListener('pointerdown', () => isSeen() && dismiss());
addEventListener('keydown', ({key}) => isSeen() && !PASSING.includes(key) && dismiss());

for (const type of ['dragover', 'dragleave', 'drop'])
  addEventListener(type, (event) => {
    if (!event.dataTransfer.types.includes('Files')) return;
    event.preventDefault();
    document.body.classList.toggle('dropping', type === 'dragover');
    if (type === 'drop') open(event.dataTransfer.files);
  });

fit();
const wanted = new URLSearchParams(location.search).get('face') || null, start = wanted ?? 'sample.sweep';
await showFile(download(start, wanted !== null), start.split('/').pop());

/** For the console. */
globalThis.sweepface = {get mesh() { return mesh; }, show};
