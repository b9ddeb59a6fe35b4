import type {Bytes, LoadOptions, Sweepface} from './sweepface.js';

/** Loads a face as Sweepface.load does, but in a worker, so that the page does not stall meanwhile. It takes some
 * milliseconds longer, and the face is ready to move at once: faults in its targets are told here. */
export function loadInWorker(bytes: Bytes, options?: LoadOptions): Promise<Sweepface>;
