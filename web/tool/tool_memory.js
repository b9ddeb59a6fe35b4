// Files in memory, by functions that are named and work as those of node:fs.
import {refused} from './tool_wasi.js';

let lastNumber = 0;

/** A file or a folder. */
class Entry {
  #id = BigInt(++lastNumber);
  #time = BigInt(Date.now()) * 1_000_000n;
  #room = new Uint8Array();
  size = 0;
  isWritten = false;

  constructor(isFolder, bytes = new Uint8Array()) {
    this.isFolder = isFolder;
    this.#room = bytes, this.size = bytes.length;
  }

  get bytes() {
    return this.#room.subarray(0, this.size);
  }
  clear() {
    this.#room = new Uint8Array();
    this.size = 0;
    this.isWritten = true;
  }
  /** Copies bytes into a file, which grows where they need it. What was given stays as it is. */
  put(bytes, position) {
    const end = position + bytes.length;
    if (end > this.#room.length || !this.isWritten) {
      const room = new Uint8Array(Math.max(end, 2 * this.size));
      room.set(this.bytes);
      this.#room = room;
    }
    this.#room.set(bytes, position);
    this.size = Math.max(this.size, end);
    this.isWritten = true;
  }
  stat() {
    const time = this.#time;
    return {dev: 1n, ino: this.#id, nlink: 1n, size: BigInt(this.size), atimeNs: time, mtimeNs: time, ctimeNs: time,
            isDirectory: () => this.isFolder, isFile: () => !this.isFolder, isSymbolicLink: () => false};
  }
}

/** The path without `.`, `..` and what is written twice. */
function normal(path) {
  const words = [];
  for (const word of path.split('/')) {
    if (word === '..') words.pop();
    else if (word !== '' && word !== '.') words.push(word);
  }
  return '/' + words.join('/');
}
const folderOf = (path) => path.slice(0, path.lastIndexOf('/')) || '/';

export class MemoryFiles {
  constants = {O_RDONLY: 0, O_WRONLY: 1, O_RDWR: 2, O_CREAT: 64, O_EXCL: 128, O_TRUNC: 512, O_APPEND: 1024};
  #entries = new Map([['/', new Entry(true)]]);  // by their normal paths
  #open = new Map();
  #next = 0;

  /** `given`: pairs of a name, which may have folders, and bytes. */
  constructor(given) {
    for (const [name, bytes] of given) {
      const path = normal(name);
      if (path === '/') throw new TypeError(`'${name}' is no name of a file.`);
      for (let k = path.indexOf('/', 1); k > 0; k = path.indexOf('/', k + 1))
        if (!this.#entries.has(path.slice(0, k))) this.#entries.set(path.slice(0, k), new Entry(true));
      this.#entries.set(path, new Entry(false, bytes));
    }
  }

  /** {name: bytes} of the files that were written. */
  written() {
    const files = [...this.#entries].filter(([, entry]) => entry.isWritten);
    return Object.fromEntries(files.map(([path, entry]) => [path.slice(1), entry.bytes.slice()]));
  }

  #find(path) {
    const at = normal(path), entry = this.#entries.get(at);
    if (entry) return entry;
    for (let folder = folderOf(at); folder !== '/'; folder = folderOf(folder))
      if (this.#entries.has(folder) && !this.#entries.get(folder).isFolder) throw refused('ENOTDIR');
    throw refused('ENOENT');
  }
  #create(path, isFolder) {
    const at = normal(path);
    if (!this.#find(folderOf(at)).isFolder) throw refused('ENOTDIR');
    const entry = new Entry(isFolder);
    this.#entries.set(at, entry);
    return entry;
  }
  #has = (path) => this.#entries.has(normal(path));
  #below = (path) => [...this.#entries.keys()].filter((other) => other !== '/' && folderOf(other) === normal(path));

  openSync = (path, how) => {
    const {O_WRONLY, O_RDWR, O_CREAT, O_EXCL, O_TRUNC, O_APPEND} = this.constants;
    const isNew = !this.#has(path);
    if (!isNew && how & O_EXCL) throw refused('EEXIST');
    const entry = isNew && how & O_CREAT ? this.#create(path, false) : this.#find(path);
    if (entry.isFolder && how & (O_WRONLY | O_RDWR)) throw refused('EISDIR');
    if (isNew || how & O_TRUNC) entry.clear();
    this.#open.set(this.#next, {entry, appends: how & O_APPEND});
    return this.#next++;
  };
  closeSync = (number) => this.#open.delete(number);
  readSync = (number, target, offset, length, position) => {
    const some = this.#open.get(number).entry.bytes.subarray(position, position + length);
    target.set(some, offset);
    return some.length;
  };
  writeSync = (number, source, offset, length, position) => {
    const {entry, appends} = this.#open.get(number);
    entry.put(source.subarray(offset, offset + length), appends ? entry.size : position);
    return length;
  };
  fstatSync = (number) => this.#open.get(number).entry.stat();
  statSync = (path) => this.#find(path).stat();
  lstatSync = (path) => this.#find(path).stat();
  readlinkSync = (path) => {
    this.#find(path);
    throw refused('EINVAL');
  };
  readdirSync = (path) => {
    if (!this.#find(path).isFolder) throw refused('ENOTDIR');
    return this.#below(path).map((at) => ({...this.#entries.get(at).stat(), name: at.slice(at.lastIndexOf('/') + 1)}));
  };
  mkdirSync = (path) => {
    if (this.#has(path)) throw refused('EEXIST');
    this.#create(path, true);
  };
  renameSync = (from, to) => {
    const entry = this.#find(from), end = normal(to);
    if (this.#has(to) && this.#find(to).isFolder) throw refused('EISDIR');
    if (entry.isFolder) throw refused('ENOTSUP');
    if (!this.#find(folderOf(end)).isFolder) throw refused('ENOTDIR');
    this.#entries.delete(normal(from));
    this.#entries.set(end, entry);
  };
  unlinkSync = (path) => {
    if (this.#find(path).isFolder) throw refused('EISDIR');
    this.#entries.delete(normal(path));
  };
  rmdirSync = (path) => {
    if (!this.#find(path).isFolder) throw refused('ENOTDIR');
    if (this.#below(path).length > 0) throw refused('ENOTEMPTY');
    this.#entries.delete(normal(path));
  };
}
