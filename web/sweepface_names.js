// Matches the names in clips and timelines with targets.
import {lowered} from './sweepface_text.js';

/** A name without differences of spelling: lower case, no separators, and a side as a final _l or _r. */
function plain(name) {
  const text = lowered(name.replace(/[_\-. ]/g, ''));
  for (const side of ['left', 'right'])
    if (text.length > side.length && text.endsWith(side)) return `${text.slice(0, -side.length)}_${side[0]}`;
  // A single letter is a side only where the name sets it apart: jawL, jaw_L, but not "curl".
  const isApart = /([_\-. ][LRlr]|[a-z][LR])$/.test(name);
  return isApart && text.length > 1 ? `${text.slice(0, -1)}_${text.at(-1)}` : text;
}

/**
 * How long the beginning is that all targets have in common, such as "Head_blendShape." and what else modelling programs put
 * in front: up to a separator, and never a whole name.
 */
function commonPrefix(targets) {
  if (targets.length < 2) return 0;
  const [first] = targets;
  let length = Math.max(0, Math.min(...targets.map((name) => name.length - 1)));
  for (const name of targets) while (!name.startsWith(first.slice(0, length))) --length;
  while (length > 0 && !/[_\-. :|]/.test(first[length - 1])) --length;
  return length;
}

/**
 * Which target each name of a clip drives: `targets` [names] of indices, `unmatched` names of the clip that drive
 * nothing, `undriven` targets that nothing drives.
 */
export function matchNames(names, targets) {
  const areTexts = (list) => Array.isArray(list) && list.every((name) => typeof name === 'string');
  if (![names, targets].every(areTexts)) throw new TypeError('Names of a clip are matched with those of a face.');
  const byName = new Map(), byPlain = new Map(), driven = new Set();
  targets.forEach((target, k) => {
    if (!byName.has(target)) byName.set(target, k);
    if (!byPlain.has(plain(target))) byPlain.set(plain(target), k);
  });
  const prefix = commonPrefix(targets), shorter = (target) => plain(target.slice(prefix));
  if (prefix > 0) targets.forEach((target, k) => byPlain.has(shorter(target)) || byPlain.set(shorter(target), k));
  const own = names.map((name) => byName.get(name) ?? byPlain.get(plain(name)));
  // A name without a side drives both, unless they have names of their own. A jaw that goes left does not go right.
  const sides = (name) => (/^(jaw|mouth)$/.test(plain(name)) ? [] : ['_l', '_r'])
      .map((side) => byPlain.get(plain(name) + side)).filter((k) => k !== undefined && !own.includes(k));
  const found = names.map((name, k) => (own[k] !== undefined ? [own[k]] : sides(name)));
  for (const k of found.flat()) driven.add(k);
  return {
    targets: found,
    unmatched: names.filter((_, k) => found[k].length === 0),
    undriven: targets.filter((_, k) => !driven.has(k))
  };
}

/** Whether any target that matchNames found says where eyes look. */
export function turnsEyes({targets: found}, targets) {
  return found.flat().some((k) => /eye.?look/i.test(targets[k]));
}
