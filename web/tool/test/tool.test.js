// The tool in WebAssembly, as a program and as functions, against the native one. SWEEPFACE_TOOL names the latter,
// SWEEPFACE_MODELS a folder of the sample face's meshes.
import assert from 'node:assert/strict';
import {execFileSync, spawn, spawnSync} from 'node:child_process';
import fs from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';
import {Sweepface} from '../../sweepface.js';
import {newFolder, tool as native} from '../../test/native.js';
import {convert, runTool} from '../sweepface_tool.js';

const cli = fileURLToPath(new URL('../cli.js', import.meta.url));
const models = process.env.SWEEPFACE_MODELS ?? fileURLToPath(new URL('../../../build/release/sample', import.meta.url));
const glb = fs.readFileSync(join(models, 'sample.glb'));

/** Runs the program in a folder: {status, stdout, stderr}. */
const run = (cwd, ...args) => spawnSync(process.execPath, [cli, ...args], {cwd, encoding: 'utf8'});
const runNative = (cwd, ...args) => spawnSync(native, args, {cwd, encoding: 'utf8'});

/** A square whose one target lifts a corner, as OBJ files. */
const neutral = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n';
const lifted = neutral.replace('v 1 1 0', 'v 1 1 0.5');
const files = {'neutral.obj': neutral, 'up.obj': lifted};

function folderOf(given) {
  const folder = newFolder();
  for (const [name, content] of Object.entries(given)) {
    fs.mkdirSync(join(folder, name, '..'), {recursive: true});
    fs.writeFileSync(join(folder, name), content);
  }
  return folder;
}

test('the program says what the native one says', () => {
  const folder = folderOf({...files, 'tiny.obj': neutral.replace('1 1 0', '1 1 1e-400'), 'zero.obj': neutral.replace('1 1 0', '1 1 0e-400'),
                           'large.obj': ''});
  fs.truncateSync(join(folder, 'large.obj'), 2200 * 2 ** 20);
  const commands = [['--version'], ['--help'], ['convert', '--help'], [], ['nothing'], ['convert', 'neutral.obj'], ['info', 'none.sweep'],
                    ['convert', 'neutral.obj', 'none.obj', '-o', 'a.sweep'], ['convert', 'neutral.obj', '-o', 'none/a.sweep'],
                    ['convert', 'neutral.obj', 'up.obj', '-o', 'neutral.obj'], ['info', '.'], ['measure', 'a', 'b', '--nothing'],
                    ['convert', 'tiny.obj', '-o', 'a.sweep'], ['convert', 'neutral.obj', 'large.obj', '-o', 'a.sweep'],
                    ['convert', 'zero.obj', '-q', '-o', '/dev/null', '--max-bytes', '4294967296']];
  for (const command of commands) {
    const {status, stdout, stderr} = run(folder, ...command), expected = runNative(folder, ...command);
    assert.deepEqual({status, stdout, stderr}, {status: expected.status, stdout: expected.stdout, stderr: expected.stderr},
                     command.join(' '));
  }
  assert.deepEqual(fs.readdirSync(folder).sort(), ['large.obj', 'neutral.obj', 'tiny.obj', 'up.obj', 'zero.obj']);
});

test('the program makes, reads and replaces files of the machine', () => {
  const folder = folderOf({'in/neutral.obj': neutral, 'in/expressions/up.obj': lifted, 'out/a.sweep': 'before'});
  fs.chmodSync(join(folder, 'out/a.sweep'), 0o640);
  const made = run(join(folder, 'in'), 'convert', 'neutral.obj', 'expressions', '-o', '../out/a.sweep', '--tolerance', '0.001');
  assert.equal(made.stderr, '');
  assert.equal(made.status, 0);
  assert.deepEqual(fs.readdirSync(join(folder, 'out')), ['a.sweep'], 'no other file is left');
  const path = join(folder, 'out/a.sweep');
  assert.equal(fs.statSync(path).mode & 0o777, 0o640);
  assert.match(run('/', 'info', path).stdout, /targets\s+1: up/);
  assert.equal(run(folder, 'measure', path, 'in/neutral.obj', 'in/expressions').status, 0);
  assert.equal(runNative(folder, 'measure', path, 'in/neutral.obj', 'in/expressions').status, 0);
  assert.equal(run(folder, 'export', path, '-o', 'all/').status, 0);
  assert.deepEqual(fs.readdirSync(join(folder, 'all')).sort(), ['expressions', 'neutral.obj']);
});

test('what cannot be written is told, and what was there stays', {skip: process.getuid?.() === 0 && 'root may write everywhere'}, () => {
  const folder = folderOf({...files, 'shut/a.sweep': 'before'});
  fs.writeFileSync(join(folder, 'b.sweep'), 'before', {mode: 0o444});
  fs.chmodSync(join(folder, 'shut'), 0o555);
  for (const output of ['shut/a.sweep', 'b.sweep']) {
    const {status, stderr} = run(folder, 'convert', 'neutral.obj', 'up.obj', '-o', output);
    assert.equal(status, 1);
    assert.match(stderr, new RegExp(`^sweepface: Cannot write ${output}: [^\\n]*Permission denied[^\\n]*\\n$`));
    assert.equal(fs.readFileSync(join(folder, output), 'utf8'), 'before');
  }
  assert.deepEqual(fs.readdirSync(folder).sort(), ['b.sweep', 'neutral.obj', 'shut', 'up.obj']);
});

test('files that a .gltf names are read beside it, and nowhere else', () => {
  const folder = newFolder();
  assert.equal(runNative(folder, 'convert', join(models, 'sample.glb'), '-o', 'face.sweep', '--tolerance', '1').status, 0);
  const length = glb.readUInt32LE(12), json = JSON.parse(glb.toString('utf8', 20, 20 + length));
  const binary = glb.subarray(28 + length, 28 + length + glb.readUInt32LE(20 + length));
  const named = (uri) => JSON.stringify({...json, buffers: [{uri, byteLength: json.buffers[0].byteLength}]});
  fs.mkdirSync(join(folder, 'model'));
  fs.writeFileSync(join(folder, 'model/data.bin'), binary);
  fs.writeFileSync(join(folder, 'outside.bin'), binary);
  fs.symlinkSync('../outside.bin', join(folder, 'model/link.bin'));
  fs.symlinkSync('data.bin', join(folder, 'model/beside.bin'));
  const outcome = (uri, at = folder) => {
    fs.writeFileSync(join(folder, 'model/a.gltf'), named(uri));
    return run(at, 'convert', at === folder ? 'model/a.gltf' : 'a.gltf', '-o', 'a.sweep', '--tolerance', '1');
  };
  for (const uri of ['data.bin', './data.bin', 'beside.bin']) assert.equal(outcome(uri).status, 0, uri);
  assert.equal(outcome('data.bin', join(folder, 'model')).status, 0);
  for (const uri of ['../outside.bin', 'link.bin', 'none.bin']) {
    const {status, stderr} = outcome(uri);
    assert.equal(status, 1, uri);
    assert.equal(stderr, runNative(folder, 'convert', 'model/a.gltf', '-o', 'a.sweep').stderr);
  }
});

test('a face is as good as the native one', async () => {
  const seen = [];
  const {bytes, report, warnings} =
    await convert(glb, {tolerance: 0.05, pack: true, onProgress: (progress) => seen.push(progress)});
  assert.equal(report.targets, 42);
  assert.ok(report.worstDistance <= 0.05 && report.worstDistance > 0.03);
  assert.equal(report.bytes, bytes.length);
  assert.deepEqual(warnings, []);
  assert.ok(seen.length > 10 && seen.every(({share, what}) => share >= 0 && share <= 1 && what.length > 0));
  const folder = folderOf({'face.sweep': bytes});
  const {shapes} = JSON.parse(runNative(folder, 'measure', 'face.sweep', join(models, 'sample.glb'), '--json').stdout);
  const worst = Math.max(...shapes.map(({distanceMax}) => distanceMax));
  assert.ok(Math.abs(worst - report.worstDistance) < 1e-6, `${worst} natively, ${report.worstDistance}`);
  const expected = runNative(folder, 'convert', join(models, 'sample.glb'), '-o', 'native.sweep', '--tolerance', '0.05', '--pack');
  assert.equal(expected.status, 0);
  const size = fs.statSync(join(folder, 'native.sweep')).size;
  assert.ok(Math.abs(bytes.length - size) < 0.02 * size, `${bytes.length} bytes, ${size} natively`);
  const face = await Sweepface.load(bytes);
  assert.equal(face.names.length, 42);
  face.dispose();
});

test('models are given as files, too', async () => {
  const {bytes, report} = await convert({...files, 'neutral.mtl': 'newmtl a\n'}, {tolerance: 0.01, bare: false});
  assert.equal(report.targets, 1);
  const ran = await runTool(['export', 'a.sweep', '-o', 'out/', '--weights', 'up=1'], {files: {'a.sweep': bytes}});
  assert.equal(ran.code, 1);
  const exported = await runTool(['export', 'a.sweep', '-o', 'lifted.obj', '--weights', 'up=1'], {files: {'a.sweep': bytes}});
  assert.deepEqual([exported.code, exported.errors, Object.keys(exported.files)], [0, '', ['lifted.obj']]);
  const heights = new TextDecoder().decode(exported.files['lifted.obj']).match(/^v .*/gm).map((line) => Number(line.split(' ')[3]));
  assert.ok(Math.abs(heights[2] - 0.5) < 0.01);
});

test('what is wrong with a model is told by the tool', async () => {
  await assert.rejects(convert(new Uint8Array(9)), {message: /^model\.glb: .*JSON/});
  await assert.rejects(convert(glb, {tolerance: -1}), {message: /--tolerance/});
  await assert.rejects(convert(glb, {tolerence: 1}), {message: /^convert\(\) has no option 'tolerence'; it has tolerance, /});
  await assert.rejects(convert(glb, {mesh: 'Nobody'}), {message: /Nobody/});
  for (const none of [{}, undefined, null, 'head.glb', 7]) await assert.rejects(convert(none), {message: /^convert\(\) needs a model/});
  await assert.rejects(convert({'a.obj': 7}), {name: 'TypeError', message: 'a.obj must be given as bytes, a Blob or a text.'});
  await assert.rejects(convert({'--help': neutral}), {message: /--help/});
  await assert.rejects(runTool('info a.sweep'), {name: 'TypeError', message: /are a list/});
  await assert.rejects(runTool(['info'], {wasm: new Uint8Array(9)}), {name: 'CompileError'});
});

test('work is ended by a signal', async () => {
  await assert.rejects(convert(glb, {signal: AbortSignal.abort()}), {name: 'AbortError'});
  const control = new AbortController(), why = new Error('enough');
  await assert.rejects(convert(glb, {signal: control.signal, onProgress: () => control.abort(why)}), why);
  await assert.rejects(convert(glb, {onProgress: () => { throw why; }}), why);
});

test('a script ends with its last call, whatever flags Node was started with', () => {
  const script = `import {convert, runTool} from '${new URL('../sweepface_tool.js', import.meta.url)}';
    const {bytes} = await convert({'a.obj': new Blob([${JSON.stringify(neutral)}]), 'b.obj': ${JSON.stringify(lifted)}});
    await convert({}).catch(() => {});
    await convert(bytes, {wasm: () => 1}).catch(() => {});
    console.log((await runTool(['info', '__proto__'], {files: {['__proto__']: bytes}})).output);`;
  const {status, stdout, stderr} =
    spawnSync(process.execPath, ['--input-type=module', '-e', script], {encoding: 'utf8', timeout: 30_000});
  assert.deepEqual([status, stderr], [0, '']);
  assert.match(stdout, /targets\s+1: b/);
});

test('pipes are read and written', () => {
  const folder = folderOf(files);
  assert.equal(run(folder, 'convert', 'neutral.obj', 'up.obj', '-o', 'a.sweep').status, 0);
  const shell = (line) => execFileSync('bash', ['-c', line.replaceAll('sweepface', `"${process.execPath}" "${cli}"`)], {cwd: folder});
  assert.match(shell('cat a.sweep | sweepface info /dev/stdin').toString(), /targets\s+1: up/);
  shell('sweepface edit a.sweep --ribbon 0 --eta 2 -q -o /dev/stdout | cat > piped.sweep');
  assert.equal(run(folder, 'check', 'piped.sweep').status, 0);
  const unread = shell('sweepface info a.sweep 2> errors | (exec <&-; sleep 2); echo ${PIPESTATUS[0]}; cat errors');
  assert.equal(unread.toString(), '141\n', 'as a native program that the signal of a closed pipe ends');
});

test('an interrupt ends the work and leaves nothing', async () => {
  const folder = newFolder();
  fs.writeFileSync(join(folder, 'sample.sweep'), (await convert(glb, {tolerance: 1})).bytes);
  const child = spawn(process.execPath, [cli, 'export', 'sample.sweep', '--lod', '8', '-o', 'big.obj'], {cwd: folder});
  let stderr = '';
  child.stderr.on('data', (text) => stderr += text);
  const ended = new Promise((resolve) => child.on('exit', resolve));
  while (!fs.readdirSync(folder).some((name) => name.endsWith('.tmp'))) {
    assert.equal(child.exitCode, null, 'it was too fast');
    await new Promise((done) => setTimeout(done, 5));
  }
  child.kill('SIGINT');
  assert.equal(await ended, 130);
  assert.equal(stderr, 'sweepface: Interrupted; no unfinished file is left.\n');
  assert.deepEqual(fs.readdirSync(folder), ['sample.sweep']);
});

test('pictures and reports are made as well', () => {
  const folder = folderOf(files), made = (...args) => assert.equal(run(folder, ...args).status, 0, args.join(' '));
  made('convert', 'neutral.obj', 'up.obj', '-o', 'a.sweep', '--tolerance', '0.001');
  made('render', 'a.sweep', '-o', 'a.png', '--weights', 'up=1', '--size', '200x150');
  made('report', 'a.sweep', 'neutral.obj', 'up.obj', '-o', 'a.html');
  made('plot', 'a.sweep', '--to', 'up=1', '-o', 'a.svg');
  made('laws', '-o', 'laws.svg');
  made('animate', 'a.sweep', '--to', 'up=1', '-o', 'a.glb');
  assert.equal(fs.readFileSync(join(folder, 'a.png')).toString('latin1', 1, 4), 'PNG');
  assert.match(fs.readFileSync(join(folder, 'a.html'), 'utf8'), /<svg/);
});
