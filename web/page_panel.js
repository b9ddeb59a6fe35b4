// The page's panel of sliders, and the figures over the picture.
import {at} from './page_message.js';

const sliders = new Map();  // by name: the row, its input and the element that shows its number

/** Builds a slider for every expression of a mesh; calls `moved` with the name and weight of each that is moved. */
export function buildSliders(mesh, moved) {
  const focused = [...sliders].find(([, {input}]) => input === document.activeElement)?.[0];
  sliders.clear();
  at('sliders').replaceChildren(...mesh.face.names.map((name) => {
    const slider = sliderOf(name, (weight) => moved(name, weight));
    sliders.set(name, slider);
    return slider.row;
  }));
  followWeights(mesh);
  filterSliders();
  sliders.get(focused)?.input.focus();
}

function sliderOf(name, moved) {
  const row = document.createElement('label'), text = document.createElement('span');
  const number = document.createElement('span'), input = document.createElement('input');
  row.className = 'slider';
  text.textContent = name;
  number.className = 'number';
  number.ariaHidden = 'true';  // the slider itself announces it; its label is the text alone
  Object.assign(input, {type: 'range', min: 0, max: 1, step: 0.01, name});
  const tell = () => {
    number.textContent = input.valueAsNumber.toFixed(2);
    moved(input.valueAsNumber);
  };
  input.addEventListener('input', tell);
  // A touch that turns into scrolling the list undoes what it moved.
  let before = 0, hasMoved = false;
  input.addEventListener('input', () => { hasMoved = true; });
  input.addEventListener('pointerdown', () => { before = input.value, hasMoved = false; });
  input.addEventListener('pointercancel', () => {
    if (!hasMoved) return;
    input.value = before;
    tell();
  });
  row.append(text, number, input);
  return {row, input, number};
}

export function followWeights(mesh) {
  for (const [name, weight] of Object.entries(mesh.face.weights)) {
    const {input, number} = sliders.get(name);
    input.value = weight;
    number.textContent = weight.toFixed(2);
  }
}

export function filterSliders() {
  const wanted = at('filter').value.trim().toLowerCase();
  for (const [name, {row}] of sliders) row.hidden = !name.toLowerCase().includes(wanted);
  const isFound = sliders.size === 0 || [...sliders.values()].some(({row}) => !row.hidden);
  at('unfound').textContent = isFound ? '' : 'No expression has this in its name.';
}

const averages = {};  // smoothed milliseconds

export function average(name, value) {
  averages[name] = averages[name] === undefined ? value : 0.9 * averages[name] + 0.1 * value;
}

const bytes = (size) => size < 1e6 ? `${(size / 1e3).toFixed(1)} KB` : `${(size / 1e6).toFixed(1)} MB`;

export function tellFigures({file, vertices, loading, memory}) {
  const rows = {
    'file': bytes(file), 'vertices': vertices.toLocaleString('en'), 'loaded in': `${loading.toFixed(0)} ms`,
    'evaluation': `${(averages.evaluation ?? 0).toFixed(2)} ms`, 'frame': `${(averages.frame ?? 0).toFixed(1)} ms`,
    'memory': bytes(memory)
  };
  at('figures').replaceChildren(...Object.entries(rows).flatMap(([name, value]) => {
    const term = document.createElement('dt'), text = document.createElement('dd');
    term.textContent = name;
    text.textContent = value;
    return [term, text];
  }));
}
