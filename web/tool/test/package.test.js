// The package as npm packs it.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';
import {newFolder} from '../../test/native.js';

const folder = fileURLToPath(new URL('..', import.meta.url));
const run = (command, parameters, cwd) =>
  execFileSync(command, parameters, {cwd, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe']});

test('the package holds what is needed; it runs, and its types fit', () => {
  const scratch = newFolder();
  const [packed] = JSON.parse(run('npm', ['pack', '--json', '--pack-destination', scratch], folder));
  assert.deepEqual(packed.files.map(({path}) => path).sort(),
                   ['LICENSE', 'README.md', 'cli.js', 'package.json', 'sweepface_tool.d.ts', 'sweepface_tool.js',
                    'sweepface_tool.wasm', 'tool_memory.js', 'tool_places.js', 'tool_thread.js', 'tool_wasi.js']);
  console.log(`sweepface-tool: ${packed.size} bytes packed, ${packed.unpackedSize} unpacked`);
  fs.writeFileSync(join(scratch, 'package.json'), '{"type": "module"}');
  run('npm', ['install', '--offline', '--no-audit', '--no-fund', `./${packed.filename}`], scratch);
  assert.match(run(join(scratch, 'node_modules/.bin/sweepface'), ['--version'], scratch), /^sweepface \d/);

  fs.writeFileSync(join(scratch, 'use.ts'), `
    import {convert, runTool, type Converted, type Ran} from 'sweepface-tool';
    const made: Converted = await convert(new Uint8Array(3), {tolerance: 0.1, pack: true, strip: ['order', 'uv'],
      mesh: ['Head', 'Neck'], onProgress: ({share, what}) => console.log(share.toFixed(2), what.length)});
    const ran: Ran = await runTool(['info', 'a.sweep', '--json'], {files: {'a.sweep': made.bytes, 'a.obj': 'v 0 0 0'}});
    console.log(new Blob([made.bytes]).size, await convert(new File([made.bytes], 'a.glb'), {shapes: false}));
    console.log(ran.code + made.report.worstDistance, made.warnings.join(), ran.files['a'].length);
    // @ts-expect-error
    await convert(3);
    // @ts-expect-error
    await convert(new Uint8Array(3), {tolerances: 1});
  `);
  const tsc = fileURLToPath(new URL('../../node_modules/.bin/tsc', import.meta.url));
  run(tsc, ['--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', '--lib', 'es2022,dom', 'use.ts'], scratch);
});
