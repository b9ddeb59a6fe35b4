// What the module sees as its files, without the module.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import {join} from 'node:path';
import test from 'node:test';
import {newFolder} from '../../test/native.js';
import {MemoryFiles} from '../tool_memory.js';
import {pathOf, place, wordOf} from '../tool_places.js';
import {Wasi} from '../tool_wasi.js';

const bytes = (text) => new TextEncoder().encode(text);
const text = (given) => new TextDecoder().decode(given);

/** The files of a disk below a folder, so that both kinds can be asked the same. */
function onDisk(given) {
  const folder = newFolder();
  for (const [name, content] of Object.entries(given)) {
    fs.mkdirSync(join(folder, name, '..'), {recursive: true});
    fs.writeFileSync(join(folder, name), content);
  }
  return [fs, (path) => folder + path];
}
const inMemory = (given) => [new MemoryFiles(Object.entries(given)), (path) => path];

/** The code of the error that a call ends with, or what it returns. */
function outcome(call) {
  try {
    return call();
  } catch (error) {
    return error.code;
  }
}

for (const [kind, make] of [['in memory', inMemory], ['on disk', onDisk]]) {
  test(`files ${kind} are read and written`, () => {
    const [files, at] = make({'a.txt': bytes('hello'), 'deep/er/b.txt': bytes('there')});
    const {O_RDONLY, O_RDWR, O_WRONLY, O_CREAT, O_EXCL, O_TRUNC} = files.constants;
    const read = (path) => {
      const file = files.openSync(at(path), O_RDONLY), room = new Uint8Array(100);
      const count = files.readSync(file, room, 0, 100, 0);
      assert.equal(Number(files.fstatSync(file, {bigint: true}).size), count);
      files.closeSync(file);
      return text(room.subarray(0, count));
    };
    const write = (path, how, ...parts) => {
      const file = files.openSync(at(path), how, 0o666);
      for (const [part, position] of parts) assert.equal(files.writeSync(file, bytes(part), 0, part.length, position), part.length);
      files.closeSync(file);
    };
    assert.equal(read('/deep/er/b.txt'), 'there');
    assert.equal(read('/deep/../a.txt'), 'hello');
    write('/new', O_CREAT | O_EXCL | O_WRONLY, ['one', 0], ['two', 3]);
    assert.equal(read('/new'), 'onetwo');
    write('/new', O_RDWR, ['T', 3]);
    assert.equal(read('/new'), 'oneTwo');
    write('/new', O_WRONLY | O_TRUNC, ['x', 0]);
    assert.equal(read('/new'), 'x');
    files.renameSync(at('/new'), at('/a.txt'));
    assert.equal(read('/a.txt'), 'x');
    assert.equal(outcome(() => files.openSync(at('/new'), O_RDONLY)), 'ENOENT');
  });

  test(`faults of files ${kind} are told`, () => {
    const [files, at] = make({'a.txt': bytes('hello'), 'folder/b.txt': bytes('there')});
    const {O_RDONLY, O_WRONLY, O_CREAT, O_EXCL} = files.constants;
    const opened = (path, how) => outcome(() => files.openSync(at(path), how, 0o666));
    assert.equal(opened('/none', O_RDONLY), 'ENOENT');
    assert.equal(opened('/none/a', O_CREAT | O_WRONLY), 'ENOENT');
    assert.equal(opened('/a.txt/b', O_RDONLY), 'ENOTDIR');
    assert.equal(opened('/a.txt/b', O_CREAT | O_WRONLY), 'ENOTDIR');
    assert.equal(opened('/a.txt', O_CREAT | O_EXCL | O_WRONLY), 'EEXIST');
    assert.equal(opened('/folder', O_WRONLY), 'EISDIR');
    assert.equal(outcome(() => files.mkdirSync(at('/folder'))), 'EEXIST');
    assert.equal(outcome(() => files.mkdirSync(at('/none/folder'))), 'ENOENT');
    assert.equal(outcome(() => files.rmdirSync(at('/folder'))), 'ENOTEMPTY');
    assert.equal(outcome(() => files.rmdirSync(at('/a.txt'))), 'ENOTDIR');
    assert.equal(outcome(() => files.unlinkSync(at('/none'))), 'ENOENT');
    assert.equal(outcome(() => files.renameSync(at('/none'), at('/b'))), 'ENOENT');
    assert.equal(outcome(() => files.renameSync(at('/a.txt'), at('/folder'))), 'EISDIR');
    assert.equal(outcome(() => files.readdirSync(at('/a.txt'), {withFileTypes: true})), 'ENOTDIR');
    assert.equal(outcome(() => files.readlinkSync(at('/a.txt'))), 'EINVAL');
    files.unlinkSync(at('/folder/b.txt'));
    files.rmdirSync(at('/folder'));
    assert.equal(outcome(() => files.statSync(at('/folder'))), 'ENOENT');
  });

  test(`folders ${kind} list what they hold`, () => {
    const [files, at] = make({'a.txt': bytes(''), 'folder/b.txt': bytes(''), 'folder/c/d.txt': bytes('')});
    const list = (path) => files.readdirSync(at(path), {withFileTypes: true})
      .map((entry) => [entry.name, entry.isDirectory()]).sort();
    assert.deepEqual(list('/'), [['a.txt', false], ['folder', true]]);
    assert.deepEqual(list('/folder'), [['b.txt', false], ['c', true]]);
    const numbers = ['/a.txt', '/folder', '/folder/b.txt'].map((path) => files.statSync(at(path), {bigint: true}).ino);
    assert.equal(new Set(numbers).size, 3, 'by which files are told apart');
  });
}

test('only what was written is returned, and what was given stays as it is', () => {
  const given = {'a.txt': bytes('hello'), 'b.txt': bytes('there'), 'c.txt': bytes('again')};
  const files = new MemoryFiles(Object.entries(given)), {O_WRONLY, O_TRUNC} = files.constants;
  for (const [name, how] of [['/b.txt', O_TRUNC], ['/c.txt', 0]]) {
    const file = files.openSync(name, O_WRONLY | how);
    files.writeSync(file, bytes('x'), 0, 1, 0);
  }
  assert.deepEqual(files.written(), {'b.txt': bytes('x'), 'c.txt': bytes('xgain')});
  assert.deepEqual(Object.values(given).map(text), ['hello', 'there', 'again']);
});

test('a file has a name', () => {
  for (const name of ['', '.', '/', 'a/..'])
    assert.throws(() => new MemoryFiles([[name, bytes('')]]), {name: 'TypeError', message: `'${name}' is no name of a file.`});
});

test('memory beyond 2 GiB is reached', async () => {
  // Writes "hi" from an address of 0x90000010 to the output, and ends with how many bytes it was told were written.
  const module = new WebAssembly.Module(Buffer.from(
    'AGFzbQEAAAABEANgBH9/f38Bf2ABfwBgAAACRgIWd2FzaV9zbmFwc2hvdF9wcmV2aWV3MQhmZF93cml0ZQAAFndhc2lfc25hcHNo' +
    'b3RfcHJldmlldzEJcHJvY19leGl0AAEDAgECBQUBAMC4AgcTAgZtZW1vcnkCAAZfc3RhcnQAAgpJAUcAQYCAgIB5QZCAgIB5NgIA' +
    'QYSAgIB5QQI2AgBBkICAgHlB6NIBNgIAQQFBgICAgHlBAUGIgICAeRAAGkGIgICAeSgCABABCw==', 'base64'));
  let output = '';
  const stream = {isTerminal: false, write: (part) => output += text(part)};
  const wasi = new Wasi({args: [], env: {}, files: new MemoryFiles([]), output: stream, errors: stream});
  assert.equal(await wasi.run(module), 2);
  assert.equal(output, 'hi');
});

test('paths of Windows begin with a slash inside', () => {
  assert.equal(pathOf('C:\\faces\\new', 'win32'), '/C:/faces/new');
  assert.equal(place('/C:/faces/new', 'win32'), 'C:/faces/new');
  assert.equal(place('/C:', 'win32'), 'C:/');
  assert.equal(wordOf('D:\\a\\b.glb', 'win32'), '/D:/a/b.glb');
  assert.equal(wordOf('a\\b.glb', 'win32'), 'a/b.glb');
  assert.equal(wordOf('--tolerance', 'win32'), '--tolerance');
  for (const name of ['/home/a', 'a\\b', 'C:\\a'])
    for (const same of [pathOf, place, wordOf]) assert.equal(same(name, 'linux'), name);
});
