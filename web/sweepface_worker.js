// Loads faces in a worker, so that a page does not stall while a file is decoded.
import {Sweepface} from './sweepface.js';
import {Shared, take} from './sweepface_file.js';
import {ownOptions} from './sweepface_regions.js';
import {bytesOf, isGiven, kindOf} from './sweepface_values.js';
import {urlOf} from './sweepface_wasm.js';

/** How long a worker without work waits for more, in milliseconds: a second face loads sooner in one that is warm. */
const PATIENCE = 10_000;

/** What the worker is to read from: a URL has to be absolute there. */
const sourceOf = (wasm) =>
  isGiven(wasm) && kindOf(wasm) !== 'WebAssembly.Module' && !bytesOf(wasm) ? urlOf(wasm).href : wasm;

let worker, ending;
let hasAnswered = false;
let count = 0;
const waiting = new Map();  // by the numbers of requests: {resolve, reject}

function end() {
  worker?.terminate();
  worker = undefined;
}

/** The worker's answer, or what went wrong with it. */
function answer({number, error, ...given}) {
  const {resolve, reject} = waiting.get(number);
  hasAnswered = true;
  waiting.delete(number);
  if (waiting.size === 0) ending = setTimeout(end, PATIENCE);
  if (error) reject(new Error(error)); else resolve(given);
}

function fail(event) {
  event.preventDefault?.();
  end();
  const [what, advice] = hasAnswered ? ['failed', ''] : ['did not start', '; see docs/javascript.md for bundlers'];
  const why = event.message ? `: ${event.message}` : advice;
  for (const {reject} of waiting.values()) reject(new Error(`The worker that loads faces ${what}${why}.`));
  waiting.clear();
}

function start() {
  if (!globalThis.Worker) throw new Error('There are no workers here; use Sweepface.load.');
  hasAnswered = false;
  worker = new Worker(new URL('./sweepface_thread.js', import.meta.url), {type: 'module'});
  worker.addEventListener('message', ({data}) => answer(data));
  worker.addEventListener('error', fail);
  worker.addEventListener('messageerror', fail);
}

/** As Sweepface.load, in a worker. The face that it promises is ready to move. */
export async function loadInWorker(given, givenOptions) {
  const {bytes} = take(given, givenOptions), options = ownOptions(givenOptions);
  if (!worker) start();
  const number = ++count;
  const made = await new Promise((resolve, reject) => {
    worker.postMessage({number, bytes, options: {...options, wasm: sourceOf(options.wasm)}}, [bytes.buffer]);
    waiting.set(number, {resolve, reject});
    clearTimeout(ending);
  });
  return new Sweepface(await Shared.taken(made));
}
