// The page's choice of the animations that a face came with.
import {AnimationMixer} from 'three';
import {at} from './page_message.js';

const choice = at('take');

let mixer, takes = [];

function option(value, text) {
  return Object.assign(document.createElement('option'), {value, textContent: text});
}

/** Offers the animations of a model, none of which plays at first. */
export function offerTakes({object, animations = []}) {
  mixer = new AnimationMixer(object);
  takes = animations;
  choice.replaceChildren(option('', 'nothing'), ...takes.map(({name}, k) => option(k, name || `animation ${k + 1}`)));
  at('takes').hidden = takes.length === 0;
}

/** Plays what is chosen from its beginning, again and again; what another has moved goes back. */
export function playTake() {
  mixer?.stopAllAction();
  if (choice.value !== '') mixer.clipAction(takes[choice.value]).play();
}

/** Lets time pass for what plays; returns whether anything does. */
export function advanceTake(seconds) {
  if (!mixer || choice.value === '') return false;
  mixer.update(seconds);
  return true;
}
