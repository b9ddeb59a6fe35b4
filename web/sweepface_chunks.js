// The chunks that a .sweep file consists of: docs/file-format-1.md.

const textOf = (bytes) => String.fromCharCode(...bytes);

/** Whether it begins as a .sweep file of any version does. */
export const isSweep = (bytes) => textOf(bytes.subarray(0, 7)) === 'SWEEPFC';

/** The chunks of a file up to the first that is cut off, as {kind, begin, end, payload, sum}. */
function* chunksOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let begin = 8; isSweep(bytes) && begin + 12 <= bytes.length;) {
    const end = begin + 12 + view.getUint32(begin + 4, true);
    if (end > bytes.length) return;
    const kind = textOf(bytes.subarray(begin, begin + 4)), payload = bytes.subarray(begin + 12, end);
    yield {kind, begin, end, payload, sum: view.getUint32(begin + 8, true)};
    begin = end;
  }
}

const CRC_TABLE = Uint32Array.from({length: 256}, (_, byte) => {
  for (let bit = 0; bit < 8; ++bit) byte = byte & 1 ? (byte >>> 1) ^ 0xedb88320 : byte >>> 1;
  return byte;
});

/** The CRC-32 of bytes in several parts, as in zip and PNG. */
export function crc32(...parts) {
  let crc = -1;
  for (const part of parts)
    for (let k = 0; k < part.length; ++k) crc = CRC_TABLE[(crc ^ part[k]) & 255] ^ (crc >>> 8);
  return ~crc >>> 0;
}

/** Chunks that hold things unpacked, which takes a hundred times the bytes of a packed face. */
const AS_THEY_ARE = ['EXAC', 'loos', 'drif', 'ordr', 'poly', 'texc', 'quad'];

/** Whether a file holds only what the usual module reads. */
export function isPacked(bytes) {
  if (!isSweep(bytes) || bytes[7] !== 2) return false;
  for (const {kind} of chunksOf(bytes))
    if (AS_THEY_ARE.includes(kind)) return false;
  return true;
}

const KIND_OF_SCENES = new TextEncoder().encode('scen');

/** The chunk of the scene, if it is whole. */
function sceneChunk(bytes) {
  for (const chunk of chunksOf(bytes))
    if (chunk.kind === 'scen') return crc32(KIND_OF_SCENES, chunk.payload) === chunk.sum ? chunk : undefined;
}

/**
 * Copies of a file without its scene, which playing does not need and which may be most of it, and of the text of that, if
 * there is one. A damaged scene stays in the file.
 */
export function parted(bytes) {
  const chunk = sceneChunk(bytes);
  if (!chunk) return {rest: bytes.slice()};
  const {begin, end, payload} = chunk, rest = new Uint8Array(bytes.length - (end - begin));
  rest.set(bytes.subarray(0, begin));
  rest.set(bytes.subarray(end), begin);
  return {rest, text: payload.slice(payload.findIndex((byte) => byte < 128) + 1)};  // after its length, a LEB128
}
