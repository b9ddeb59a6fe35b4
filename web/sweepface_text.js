// Reads the text, numbers and JSON of clips and timelines.
import {bytesOf} from './sweepface_values.js';

const decoder = new TextDecoder();

/** The text of a clip or timeline; messages call it `name`. */
export function textOf(source, what, name) {
  if (typeof source === 'string') return source.replace(/^\uFEFF/, '');
  const bytes = bytesOf(source);
  if (!bytes) throw new TypeError(`A ${what} is read from text or bytes.`);
  if (['255,254', '254,255'].includes(bytes.subarray(0, 2).join()))
    throw new Error(`${name} is a text in UTF-16; save it in UTF-8.`);
  return decoder.decode(bytes.slice());  // a copy, as browsers do not decode shared memory
}

export const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/** "a, b and 3 more": lists at most six of the texts. */
export const fewOf = (texts) =>
  texts.slice(0, 6).join(', ') + (texts.length > 6 ? ` and ${texts.length - 6} more` : '');

/** Lower case, of A to Z only. */
export const lowered = (text) => text.replace(/[A-Z]/g, (letter) => letter.toLowerCase());

/** How engines that do not count characters say that a text ends too soon. */
const CUT_SHORT = /^(JSON.parse: |JSON Parse error: )?(unexpected )?(end|EOF|unterminated)/i;

export function parseJson(text, name) {
  try {
    return JSON.parse(text);
  } catch (error) {
    // Engines each word the position in their own way, or do not give it.
    const [, at, , told] = error.message.match(/ at (?:position (\d+)( \(.*\))?|line (\d+) column.*)$/) ?? [];
    const isCut = at === undefined ? CUT_SHORT.test(error.message) : at >= text.length;
    const line = isCut || at ? text.slice(0, isCut ? undefined : at).split('\n').length : told;
    const what = `${line ? `, line ${line}: this` : ''} is not JSON${isCut ? '; was the file cut short?' : '.'}`;
    throw new Error(name + what, {cause: error});
  }
}
