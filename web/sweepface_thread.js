// The worker of sweepface/worker: opens files, and hands over the memory in which they are ready to move.
import {open} from './sweepface_file.js';

addEventListener('message', async ({data: {number, bytes, options}}) => {
  try {
    const shared = await open(bytes, options);
    shared.prepare();
    const given = shared.give();
    postMessage({number, ...given}, [given.memory]);
  } catch (error) {
    postMessage({number, error: error.message});
  }
});
