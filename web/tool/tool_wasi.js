// WASI preview 1, as far as the tool uses it, over functions that are named and work as those of node:fs.

/** WASI's numbers for what node:fs calls the codes of errors. */
const ERRNO = {
  EACCES: 2, EAGAIN: 6, EBADF: 8, EBUSY: 10, EDQUOT: 19, EEXIST: 20, EFBIG: 22, EINTR: 27, EINVAL: 28, EIO: 29, EISDIR: 31,
  ELOOP: 32, EMFILE: 33, ENAMETOOLONG: 37, ENFILE: 41, ENOENT: 44, ENOMEM: 48, ENOSPC: 51, ENOSYS: 52, ENOTDIR: 54,
  ENOTEMPTY: 55, ENOTSUP: 58, EPERM: 63, EPIPE: 64, EROFS: 69, ESPIPE: 70, ETXTBSY: 74, EXDEV: 75,
};
const KIND = {device: 2, folder: 3, file: 4, link: 7};
const CREATE = 1, FOLDER = 2, EXCLUSIVE = 4, TRUNCATE = 8;  // how to open
const APPEND = 1, FOLLOW = 1;
const MAY_READ = 2n, MAY_WRITE = 64n, EVERY_RIGHT = (1n << 30n) - 1n;
const SEEK_AND_TELL = 4n | 32n;  // what wasi-libc looks at to tell a terminal from other devices
const ROOT = 3;  // the only folder that the module is given; all paths are below it

/** An error as those of node:fs are. */
export const refused = (code) => Object.assign(new Error(code), {code});

/** Thrown by the module to end. */
class Exit {
  constructor(code) {
    this.code = code;
  }
}

const kindOf = (entry) =>
  entry.isDirectory() ? KIND.folder : entry.isSymbolicLink() ? KIND.link : entry.isFile() ? KIND.file : KIND.device;

/**
 * What a module of WASI imports.
 * `files`: node:fs, or what works as it does. `place`: where one of the module's absolute paths is there. `output`,
 * `errors`: {isTerminal, write(bytes)}.
 */
export class Wasi {
  #args;
  #env;
  #files;
  #place;
  #open;
  #next = ROOT + 1;
  #memory;

  constructor({args, env, files, place = (path) => path, output, errors}) {
    this.#args = this.#texts(args);
    this.#env = this.#texts(Object.entries(env).map(([name, value]) => `${name}=${value}`));
    this.#files = files;
    this.#place = place;
    this.#open = new Map([[0, {stream: {isTerminal: false}}], [1, {stream: output}], [2, {stream: errors}],
                          [ROOT, {path: '', isFolder: true}]]);
  }

  /** Runs a compiled module; returns its exit code. */
  async run(module) {
    const instance = await WebAssembly.instantiate(module, {wasi_snapshot_preview1: this.#imports()});
    this.#memory = instance.exports.memory;
    try {
      instance.exports._start();
      return 0;
    } catch (error) {
      if (error instanceof Exit) return error.code;
      throw error;
    } finally {
      for (const {handle} of this.#open.values()) if (handle !== undefined) this.#files.closeSync(handle);
    }
  }

  #texts(texts) {
    return texts.map((text) => new TextEncoder().encode(text + '\0'));
  }
  get #view() {
    return new DataView(this.#memory.buffer);
  }
  #bytes(pointer, length) {
    return new Uint8Array(this.#memory.buffer, pointer, length);
  }
  /** The parts of memory that a list of (pointer, length) names. */
  #parts(pointer, count) {
    const view = this.#view;
    return Array.from({length: count}, (_, k) =>
      this.#bytes(view.getUint32(pointer + 8 * k, true), view.getUint32(pointer + 8 * k + 4, true)));
  }
  #opened(number) {
    const found = this.#open.get(number);
    if (!found) throw refused('EBADF');
    return found;
  }
  #path(folder, pointer, length) {
    const {path, isFolder} = this.#opened(folder);
    if (!isFolder) throw refused('ENOTDIR');
    return `${path}/${new TextDecoder().decode(this.#bytes(pointer, length))}`;
  }

  #putTexts(texts, pointers, pointer) {
    for (const text of texts) {
      this.#view.setUint32(pointers, pointer, true);
      this.#bytes(pointer, text.length).set(text);
      pointers += 4, pointer += text.length;
    }
  }
  #putSizes(texts, count, bytes) {
    this.#view.setUint32(count, texts.length, true);
    this.#view.setUint32(bytes, texts.reduce((sum, text) => sum + text.length, 0), true);
  }
  #putStat(pointer, stat) {
    const view = this.#view;
    const times = [stat.atimeNs, stat.mtimeNs, stat.ctimeNs];
    [stat.dev, stat.ino, BigInt(kindOf(stat)), stat.nlink, stat.size, ...times].forEach((value, k) =>
      view.setBigUint64(pointer + 8 * k, BigInt.asUintN(64, value), true));
  }

  #openPath(path, how, rights, flags) {
    const {constants} = this.#files;
    if (how & FOLDER) {
      if (!this.#files.statSync(this.#place(path)).isDirectory()) throw refused('ENOTDIR');
      return {path, isFolder: true};
    }
    const writes = (rights & MAY_WRITE) !== 0n;
    if (!writes && !(how & CREATE) && this.#files.statSync(this.#place(path)).isDirectory()) return {path, isFolder: true};
    const access = !writes ? constants.O_RDONLY : rights & MAY_READ ? constants.O_RDWR : constants.O_WRONLY;
    const mode = access | (how & CREATE ? constants.O_CREAT : 0) | (how & EXCLUSIVE ? constants.O_EXCL : 0) |
      (how & TRUNCATE ? constants.O_TRUNC : 0) | (flags & APPEND ? constants.O_APPEND : 0);
    const handle = this.#files.openSync(this.#place(path), mode, 0o666);
    const isFile = this.#files.fstatSync(handle).isFile();  // and no pipe, which has no positions
    return {path, handle, position: 0, hasPosition: isFile && !(flags & APPEND)};
  }

  /** Reads or writes parts one after another; returns how many bytes that were. */
  #transfer(file, parts, step) {
    let all = 0;
    for (const part of parts) {
      const count = step(file.handle, part, 0, part.length, file.hasPosition ? file.position : null);
      file.position += count, all += count;
      if (count < part.length) break;
    }
    return all;
  }

  #read(number, pointer, count, read) {
    const file = this.#opened(number);
    if (file.isFolder) throw refused('EISDIR');
    const parts = file.stream ? [] : this.#parts(pointer, count);
    this.#view.setUint32(read, this.#transfer(file, parts, this.#files.readSync), true);
  }

  #write(number, pointer, count, written) {
    const file = this.#opened(number), parts = this.#parts(pointer, count);
    if (file.stream && !file.stream.write) throw refused('EBADF');
    let all = 0;
    if (file.stream) {
      for (const part of parts) file.stream.write(part.slice()), all += part.length;
    } else {
      all = this.#transfer(file, parts, this.#files.writeSync);
    }
    this.#view.setUint32(written, all, true);
  }

  #seek(number, offset, from, result) {
    const file = this.#opened(number);
    if (!file.hasPosition) throw refused(file.isFolder ? 'EISDIR' : 'ESPIPE');
    const base = [0, file.position, Number(this.#files.fstatSync(file.handle).size)][from];
    const position = base + Number(offset);
    if (!(position >= 0)) throw refused('EINVAL');
    file.position = position;
    this.#view.setBigUint64(result, BigInt(position), true);
  }

  #readFolder(number, pointer, length, cookie, used) {
    const folder = this.#opened(number);
    if (!folder.isFolder) throw refused('ENOTDIR');
    if (cookie === 0n || !folder.entries) {
      const entries = this.#files.readdirSync(this.#place(folder.path || '/'), {withFileTypes: true});
      folder.entries = entries.map((entry) => ({name: new TextEncoder().encode(entry.name), kind: kindOf(entry)}));
    }
    let end = 0;
    for (let k = Number(cookie); k < folder.entries.length && end < length; ++k) {
      const {name, kind} = folder.entries[k], head = new DataView(new ArrayBuffer(24));
      head.setBigUint64(0, BigInt(k + 1), true);
      head.setUint32(16, name.length, true);
      head.setUint8(20, kind);
      // What does not fit any more is cut off; the module asks again with more room.
      for (const part of [new Uint8Array(head.buffer), name]) {
        const some = part.subarray(0, length - end);
        this.#bytes(pointer + end, some.length).set(some);
        end += some.length;
      }
    }
    this.#view.setUint32(used, end, true);
  }

  #fdstat(number, pointer) {
    const {stream, isFolder} = this.#opened(number);
    const kind = isFolder ? KIND.folder : stream?.isTerminal ? KIND.device : KIND.file;
    const view = this.#view;
    view.setBigUint64(pointer, BigInt(kind), true);
    view.setBigUint64(pointer + 8, stream ? EVERY_RIGHT & ~SEEK_AND_TELL : EVERY_RIGHT, true);
    view.setBigUint64(pointer + 16, EVERY_RIGHT, true);
  }

  #close(number) {
    const {handle} = this.#opened(number);
    this.#open.delete(number);
    if (handle !== undefined) this.#files.closeSync(handle);
  }

  #imports() {
    const files = this.#files, at = (...path) => this.#place(this.#path(...path));
    const calls = {
      args_sizes_get: (count, bytes) => this.#putSizes(this.#args, count, bytes),
      args_get: (pointers, pointer) => this.#putTexts(this.#args, pointers, pointer),
      environ_sizes_get: (count, bytes) => this.#putSizes(this.#env, count, bytes),
      environ_get: (pointers, pointer) => this.#putTexts(this.#env, pointers, pointer),
      clock_time_get: (clock, precision, result) => {
        const milliseconds = clock === 0 ? Date.now() : performance.now();
        this.#view.setBigUint64(result, BigInt(Math.round(milliseconds * 1e6)), true);
      },
      fd_close: (number) => this.#close(number),
      fd_fdstat_get: (number, pointer) => this.#fdstat(number, pointer),
      fd_fdstat_set_flags: () => {},
      fd_filestat_get: (number, pointer) => {
        const {handle, path = ''} = this.#opened(number);
        this.#putStat(pointer, handle === undefined ? files.statSync(this.#place(path || '/'), {bigint: true})
                                                    : files.fstatSync(handle, {bigint: true}));
      },
      fd_prestat_get: (number, pointer) => {
        if (number !== ROOT) throw refused('EBADF');
        this.#view.setBigUint64(pointer, 1n << 32n, true);
      },
      fd_prestat_dir_name: (number, pointer) => this.#bytes(pointer, 1).set([0x2f]),
      fd_read: (...given) => this.#read(...given),
      fd_readdir: (...given) => this.#readFolder(...given),
      fd_seek: (...given) => this.#seek(...given),
      fd_write: (...given) => this.#write(...given),
      path_create_directory: (...path) => files.mkdirSync(at(...path)),
      path_filestat_get: (folder, flags, path, length, pointer) => {
        const look = flags & FOLLOW ? files.statSync : files.lstatSync;
        this.#putStat(pointer, look(at(folder, path, length), {bigint: true}));
      },
      path_open: (folder, follow, path, length, how, rights, inherited, flags, result) => {
        const opened = this.#openPath(this.#path(folder, path, length), how, rights, flags);
        this.#open.set(this.#next, opened);
        this.#view.setUint32(result, this.#next++, true);
      },
      path_readlink: (folder, path, length, pointer, room, used) => {
        const link = new TextEncoder().encode(files.readlinkSync(at(folder, path, length))).subarray(0, room);
        this.#bytes(pointer, link.length).set(link);
        this.#view.setUint32(used, link.length, true);
      },
      path_remove_directory: (...path) => files.rmdirSync(at(...path)),
      path_rename: (folder, path, length, ...to) => files.renameSync(at(folder, path, length), at(...to)),
      path_unlink_file: (...path) => files.unlinkSync(at(...path)),
    };
    // Beyond 2 GiB addresses come as negative numbers.
    const answered = (call) => (...given) => {
      try {
        call(...given.map((value) => typeof value === 'number' ? value >>> 0 : value));
        return 0;
      } catch (error) {
        if (error?.code === undefined) throw error;
        return ERRNO[error.code] ?? ERRNO.EIO;
      }
    };
    const imports = Object.fromEntries(Object.entries(calls).map(([name, call]) => [name, answered(call)]));
    imports.proc_exit = (code) => {
      throw new Exit(code);
    };
    return imports;
  }
}
