// Clips for faces: captures of Live Link Face (CSV), MediaPipe and Audio2Face (JSON) and timelines, as docs/clips.md
// describes them. They are read as the C++ library reads them, but in plain JavaScript, which parses text and JSON
// itself: no WebAssembly module is fetched.
export {readClip} from './sweepface_captures.js';
export {Clip, ClipPlayer} from './sweepface_clip.js';
export {matchNames} from './sweepface_names.js';
export {readTimeline, TimelinePlayer} from './sweepface_timeline.js';
