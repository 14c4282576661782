// SPDX-License-Identifier: MIT
//
// The folder that `npm pack` makes a package of: what is in it, that its parts name each other, how large it is, and that
// its types are those of what a host writes (types/usage.ts).
//   node package_files.mjs --package FOLDER --version VERSION --tools FOLDER
// tsc and the types of WebGPU are what npm brings into --tools; where it cannot, types are skipped with the reason. Exits with 1 where something does not hold, with 77 where something was skipped.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {cpSync, existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {brotliCompressSync, gzipSync} from 'node:zlib';

const option = name => process.argv[process.argv.indexOf(name) + 1];
const folder = option('--package');
const tools = path.resolve(option('--tools'));
mkdirSync(tools, {recursive: true});
const here = path.dirname(fileURLToPath(import.meta.url));
const read = name => readFileSync(path.join(folder, name), 'utf8');
const run = (program, ...args) => spawnSync(program, args, {encoding: 'utf8', cwd: tools, timeout: 120_000});
let skipped = 0;

const skip = (what, why) => {
    ++skipped;
    console.log(`skipped ${what}: ${why}`);
};

const expected = ['LICENSE', 'README.md', 'arguments.js', 'bridge.js', 'depth_copy.js', 'gnomon-shadows.mjs', 'gnomon-shadows.wasm',
                  'index.d.ts', 'index.js', 'package.json', 'position.js'];

function checkPackage() {
    const about = JSON.parse(read('package.json'));
    assert.equal(about.version, option('--version'));
    assert.deepEqual([...about.files, 'package.json'].sort(), expected);
    for (const name of expected) assert.ok(existsSync(path.join(folder, name)), `${name} is missing`);
    const {types, default: file} = about.exports['.'];
    for (const name of [types, file, about.types, about.main]) assert.ok(expected.includes(path.basename(name)), name);
}

function checkImports() {
    for (const name of expected.filter(n => /\.m?js$/.test(n))) {
        for (const [, from] of read(name).matchAll(/^(?:import|export) .* from '(\.[^']*)';/gm)) {
            assert.ok(expected.includes(path.basename(from)), `${name} imports ${from}, which is not in the package`);
        }
    }
}

function checkPacking() {
    if (run('npm', '--version').status !== 0) return skip('the packing', 'there is no npm');
    const packed = run('npm', 'pack', '--dry-run', '--json', '--offline', path.resolve(folder));
    assert.equal(packed.status, 0, packed.stderr);
    const [{files, size, unpackedSize}] = JSON.parse(packed.stdout);
    assert.deepEqual(files.map(file => file.path).sort(), expected);
    console.log(`ok      npm pack takes ${files.length} files: ${size} bytes, ${unpackedSize} unpacked`);
    const wasm = readFileSync(path.join(folder, 'gnomon-shadows.wasm'));
    console.log(`        gnomon-shadows.wasm: ${wasm.length} bytes, ${gzipSync(wasm, {level: 9}).length} by gzip, ` +
                `${brotliCompressSync(wasm).length} by brotli`);
}

/// TypeScript's compiler, with the types of WebGPU beside it; null where it does not come.
function findTypes() {
    const modules = path.join(tools, 'node_modules');
    const local = path.join(modules, 'typescript/bin/tsc');
    if (!existsSync(local) || !existsSync(path.join(modules, '@webgpu/types'))) {
        writeFileSync(path.join(tools, 'package.json'), '{"private": true}\n');
        const brought = run('npm', 'install', '--no-audit', '--no-fund', 'typescript@5', '@webgpu/types');
        if (brought.status !== 0) return null;
    }
    return local;
}

function checkTypes() {
    const tsc = findTypes();
    if (!tsc) return skip('the types', 'npm does not bring typescript and @webgpu/types (is there a network?)');
    const work = path.join(tools, 'types');
    rmSync(work, {recursive: true, force: true});
    mkdirSync(work);
    cpSync(path.join(here, 'types'), work, {recursive: true, dereference: true});
    const link = path.join(tools, 'node_modules/gnomon-shadows');
    rmSync(link, {force: true});
    symlinkSync(path.resolve(folder), link);
    const flags = ['--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', '--moduleResolution', 'nodenext',
                   '--lib', 'es2022,dom', '--types', '@webgpu/types', '--preserveSymlinks'];
    const checked = run(process.execPath, tsc, ...flags, path.join(work, 'usage.ts'));
    assert.equal(checked.status, 0, checked.stdout + checked.stderr);
    console.log(`ok      types are those of what a host writes (TypeScript ${run(process.execPath, tsc, '--version').stdout.trim()})`);
}

let failed = 0;
for (const check of [checkPackage, checkImports, checkPacking, checkTypes]) {
    try {
        check();
    } catch (error) {
        ++failed;
        console.log(`FAILED  ${check.name}: ${error.message}`);
    }
}
process.exitCode = failed > 0 ? 1 : skipped > 0 ? 77 : 0;
