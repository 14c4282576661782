// SPDX-License-Identifier: MIT
//
// The package for pages with a renderer of their own, in the browser: its masks against the truth, what it refuses, what it
// frees, and the examples.
//   node package.mjs --site FOLDER --out FOLDER [--frames N]
// three.js, for its example, is what npm brings into the site's folder; where it cannot, that example is skipped with the reason.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync, readFileSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

import {check, claim, option} from './visitor.mjs';

const frames = Number(option('--frames', '1000'));
const probe = {path: 'probe/'};

/// What an async function of the page's comes to; `probe` is its argument.
const inPage = (visitor, body, ...args) =>
    visitor.evaluate(`(${body})(window.probe, ...${JSON.stringify(args)})`);

// At four samples SwiftShader's rasteriser moves edges by more than the band, and gets single samples wrong
// (docs/hard-cases.md, "On another rasteriser"): these pixels, with scissors and without, in either kind of depth.
const strays = 4;

const ways = [
    ['32-bit floats, reversed, without a far plane', {}],
    ['32-bit floats, forward', {reversed: false}],
    ['with a far plane', {far: 60}],
    ['with a far plane, forward', {far: 60, reversed: false}],
    ['a stencil that is used', {format: 'depth32float-stencil8', stencil: 0}],
    ['a stencil that is kept', {format: 'depth32float-stencil8', keepStencil: true, stencil: 77}],
    ['24 bits or more, forward', {format: 'depth24plus', reversed: false}],
    ['24 bits or more, reversed', {format: 'depth24plus'}],
    ['24 bits or more beside a stencil', {format: 'depth24plus-stencil8', reversed: false, stencil: 77}],
    ['in an encoder of the host\'s', {inEncoder: true}],
    ['a stencil that is used in an encoder of the host\'s', {format: 'depth32float-stencil8', inEncoder: true, stencil: 0}],
    ['shares of one sample', {masks: 'shares'}],
    ['shares of four samples', {masks: 'shares', samples: 4, known: strays}],
    ['shares of four samples in a stencil that is used', {masks: 'shares', samples: 4, format: 'depth32float-stencil8', known: strays}],
    ['positions by a shader of the host\'s own, with the bias', {exact: false}],
    ['positions by a shader of the host\'s own, forward', {exact: false, reversed: false, far: 60}],
    ['averted caps', {averted: true}],
];

claim('masks are the truth outside of a band of 1/8 pixel, in each way that depth comes', async visitor => {
    for (const [name, {stencil, known = 0, ...way}] of ways) {
        const {wrong, judged, shadowed, ...more} = await inPage(visitor, 'async (probe, way) => probe.judge(way)', way);
        console.log(`        ${name}: ${wrong} of ${judged} wrong, ${shadowed} in shadow`);
        assert.ok(shadowed > 1000 && judged > 4000, `${name}: ${shadowed} of ${judged}`);
        assert.ok(wrong <= known, `${name}: ${wrong} are wrong`);
        if (stencil !== undefined) assert.deepEqual(more.stencil, [stencil], name);
    }
}, probe);


/// A device with shadows and the host's depth, for `use`, in the page.
const scene = `async (probe, use) => {
    const device = await probe.newDevice();
    const shadows = await probe.createShadows(device, {capBias: null});
    const things = probe.fill(shadows);
    const encoder = device.createCommandEncoder();
    const {RENDER_ATTACHMENT, TEXTURE_BINDING} = GPUTextureUsage;
    const host = probe.drawDepth(device, encoder, {
        format: 'depth32float', samples: 1, reversed: true, far: 0, exact: true, usage: RENDER_ATTACHMENT | TEXTURE_BINDING});
    device.queue.submit([encoder.finish()]);
    const how = {depth: host.depth, view: probe.view, projection: host.projection, reversed: true};
    const judged = async (places, lights) => probe.judged(
        await probe.read(device, shadows.render(how).mask, Uint32Array), places, lights).wrong;
    return use({probe, device, shadows, things, host, how, judged});
}`;
const inScene = (visitor, use) => visitor.evaluate(`(${scene})(window.probe, ${use})`);

claim('casters come, go, hide and move', async visitor => {
    const wrong = await inScene(visitor, `async ({probe, shadows, things: {casters, meshes}, judged}) => {
        const wrong = {all: await judged()};
        const without = place => probe.everything.filter(i => i !== place);
        casters[1].visible = false;
        wrong.hidden = await judged(without(1));
        casters[1].visible = true;
        wrong.shown = await judged();
        casters[4].remove();
        casters[4].remove();
        wrong.removed = await judged(without(4));
        // The number of the one that went last is given again at once, with another mesh.
        casters[5].remove();
        const box = shadows.addCaster(meshes.get(probe.box));
        wrong.elsewhere = await judged(without(5)) > 0 ? 0 : 'it is as if it stood where it will';
        box.setTransform(new Float32Array(probe.things[4].pose));
        wrong.moved = await judged(without(5));
        box.setMesh(meshes.get(probe.sheet));
        box.setTransform(probe.things[5].pose);
        wrong.otherMesh = await judged(without(4));
        // Casters keep meshes that are removed.
        meshes.get(probe.sheet).remove();
        wrong.meshRemoved = await judged(without(4));
        const deformed = meshes.get(probe.box).deformed(probe.box.positions.map(v => v * 2));
        casters[2].setMesh(deformed);
        casters[2].setTransform(probe.things[2].pose.map((v, i) => i < 12 ? v / 2 : v));
        wrong.deformed = await judged(without(4));
        return wrong;
    }`);
    for (const [name, count] of Object.entries(wrong)) assert.equal(count, 0, name);
}, probe);

claim('lights come, go and change, and the bits of others stay', async visitor => {
    const wrong = await inScene(visitor, `async ({probe, shadows, things: {lights}, judged}) => {
        const [a, b, c] = probe.lights;
        const wrong = {all: await judged()};
        lights[1].remove();
        lights[1].remove();
        wrong.bits = lights[0].bit === 0 && lights[2].bit === 2 ? 0 : 'other bits';
        wrong.gone = await judged(probe.everything, [a, null, c]);
        const again = shadows.addLight(b);
        wrong.bit = again.bit === 1 ? 0 : again.bit;
        wrong.back = await judged();
        again.set({type: 'point', position: c.position});
        wrong.changed = await judged(probe.everything, [a, c, c]);
        again.set({range: 0.1});
        wrong.short = await judged(probe.everything, [a, null, c]);
        again.set({range: Infinity});
        wrong.far = await judged(probe.everything, [a, c, c]);
        lights[2].remove();
        again.remove();
        wrong.first = await judged(probe.everything, [a]);
        lights[0].remove();
        wrong.none = await judged(probe.everything, []);
        const many = Array.from({length: 32}, (_, i) => shadows.addLight({...[a, b, c][i % 3]}));
        wrong.many = await judged(probe.everything, many.map((_, i) => [a, b, c][i % 3]));
        try {
            shadows.addLight(a);
            wrong.limit = 'taken';
        } catch (error) {
            wrong.limit = error instanceof RangeError && /^There are 32 lights already/.test(error.message) ? 0 : error.message;
        }
        return wrong;
    }`);
    for (const [name, count] of Object.entries(wrong)) assert.equal(count, 0, name);
}, probe);

claim('a frame in which nothing moved finds nothing anew and uploads nothing', async visitor => {
    const frames = await inScene(visitor, `async ({shadows, things, how}) => {
        const stats = () => shadows.render(how).stats;
        const frames = [stats(), stats()];
        things.lights[0].set({position: [1, 3.1, 1.6]});
        frames.push(stats());
        return frames;
    }`);
    assert.equal(frames[0].pairsRedetected, 18);
    assert.ok(frames[0].uploadedBytes > 0 && frames[0].depthPassPairs + frames[0].depthFailPairs > 0);
    assert.equal(frames[1].pairsRedetected, 0);
    assert.equal(frames[1].uploadedBytes, 0);
    assert.ok(frames[2].pairsRedetected <= 6 && frames[2].uploadedBytes > 0, JSON.stringify(frames[2]));
}, probe);

claim('meshes say what they are', async visitor => {
    const [box, sheet] = await inScene(visitor, `({probe, things: {meshes}}) =>
        [meshes.get(probe.box).report, meshes.get(probe.sheet).report]`);
    assert.deepEqual([box.closed, box.triangles, box.weldedVertices, box.edges, box.boundaryEdges], [true, 12, 8, 18, 0]);
    assert.deepEqual([sheet.closed, sheet.triangles, sheet.weldedVertices, sheet.edges, sheet.boundaryEdges], [false, 2, 4, 5, 4]);
}, probe);

claim('the types name the members that there are', async visitor => {
    const {members, types} = await visitor.evaluate(`(async ({others}) => {
        const types = await (await fetch('../node_modules/gnomon-shadows/index.d.ts')).text();
        const kinds = ['Caster', 'Light', 'Mesh', 'Shadows', 'View'];
        const named = kind => new Set(Object.getOwnPropertyNames(kind.prototype).filter(name => name !== 'constructor'));
        // 'removed' is inherited by all but Shadows; these are set by constructors.
        const more = {Mesh: ['report'], Shadows: ['features', 'lost']};
        const members = Object.fromEntries(kinds.map(name => [name, [
            ...named(others[name]), ...(name === 'Shadows' ? [] : ['removed']), ...(more[name] ?? [])].sort()]));
        return {members, types};
    })(window.probe)`);
    for (const [kind, names] of Object.entries(members)) {
        const body = types.slice(types.indexOf(`declare class ${kind} {`)).split('\n}\n')[0];
        const declared = [...body.matchAll(/^    (?:readonly )?(\w+)[(:]/gm)].map(([, name]) => name);
        assert.deepEqual([...new Set(declared)].sort(), names, kind);
    }
}, probe);

claim('several views share one encoder, each with a mask of its own', async visitor => {
    const found = await inScene(visitor, `async ({probe, device, shadows, host, how}) => {
        const second = shadows.addView();
        const encoder = device.createCommandEncoder();
        const {mask} = shadows.render({...how, encoder});
        const elsewhere = probe.view.map((v, i) => i === 12 ? v - 3 : v);
        const other = second.render({...how, encoder, view: elsewhere});
        let twice = '';
        try { shadows.render({...how, encoder}); } catch (error) { twice = error.message; }
        device.queue.submit([encoder.finish()]);
        const first = probe.judged(await probe.read(device, mask, Uint32Array)).wrong;
        const there = probe.judged(await probe.read(device, other.mask, Uint32Array)).wrong;
        second.remove();
        let removed = '';
        try { second.render(how); } catch (error) { removed = error.message; }
        return {first, there, twice, removed};
    }`);
    assert.equal(found.first, 0);
    assert.ok(found.there > 0, 'the other view has the mask of the first');
    assert.match(found.twice, /^This view is in that encoder already, .*\.$/);
    assert.equal(found.removed, 'This view was removed.');
}, probe);

claim('another depth, another size and the other direction of depth are taken as they come', async visitor => {
    const found = await inScene(visitor, `async ({probe, device, shadows, how, judged}) => {
        const wrong = [await judged()];
        const masks = new Set([shadows.render(how).mask]);
        const {RENDER_ATTACHMENT, TEXTURE_BINDING} = GPUTextureUsage;
        for (const way of [{format: 'depth32float', reversed: false}, {format: 'depth32float-stencil8', reversed: true},
                           {format: 'depth32float-stencil8', reversed: true}, {format: 'depth24plus', reversed: false}]) {
            const encoder = device.createCommandEncoder();
            const {depth, projection} = probe.drawDepth(device, encoder, {
                samples: 1, far: 0, exact: true, usage: RENDER_ATTACHMENT | TEXTURE_BINDING, ...way});
            device.queue.submit([encoder.finish()]);
            const {mask} = shadows.render({depth, view: probe.view, projection, reversed: way.reversed});
            masks.add(mask);
            wrong.push(probe.judged(await probe.read(device, mask, Uint32Array)).wrong);
        }
        const small = device.createTexture({size: [16, 8], format: 'depth32float', usage: RENDER_ATTACHMENT | TEXTURE_BINDING});
        const {mask} = shadows.render({...how, depth: small});
        return {wrong, masks: masks.size, size: [mask.width, mask.height]};
    }`);
    assert.deepEqual(found, {wrong: [0, 0, 0, 0, 0], masks: 1, size: [16, 8]});
}, probe);

// What is done, what is thrown, and what it says.
const refusals = [
    ['createShadows(null)', 'TypeError', /^createShadows\(\) takes a GPUDevice, not null\.$/],
    ["createShadows(device, {mask: 'bits'})", 'TypeError', /^createShadows\(\) knows no "mask": it takes masks, capBias, wasm\.$/],
    ["createShadows(device, {masks: 'bytes'})", 'RangeError', /^masks of createShadows\(\) is "bytes" instead of "bits" or "shares"\.$/],
    ['createShadows(device, {capBias: {constant: -1, slopeScale: 0}})', 'RangeError', /^capBias\.constant of createShadows\(\) is -1, /],
    ['createShadows(device, {capBias: {constant: 0.5, slopeScale: 0}})', 'RangeError', /^capBias\.constant of createShadows\(\) is 0\.5 instead of a whole number\.$/],
    ['createShadows(device, {wasm: 7})', 'TypeError', /^wasm of createShadows\(\) is 7 instead of a URL/],
    ['featuresOf(device)', 'TypeError', /^featuresOf\(\) takes a GPUAdapter, not a GPUDevice\.$/],
    ['shadows.addMesh()', 'TypeError', /^addMesh\(\) takes an object, not undefined\.$/],
    ['shadows.addMesh({positions: [0, 0, 0]})', 'TypeError', /^positions of addMesh\(\) is Array of 3 instead of a Float32Array\.$/],
    ['shadows.addMesh({positions: new Float32Array(4)})', 'RangeError', /^positions of addMesh\(\) has 4 floats, /],
    ['shadows.addMesh({positions: new Float32Array(9), indices: [0, 1, 2]})', 'TypeError', /^indices of addMesh\(\) is Array of 3 /],
    ['shadows.addMesh({positions: new Float32Array(9), indices: new Uint32Array([0, 1, 3])})', 'RangeError', /\b3\b.*\.$/],
    ['shadows.addMesh({positions: new Float32Array(9), indices: new Uint32Array([0, 1])})', 'RangeError', /\b2\b.*\.$/],
    ['shadows.addMesh({positions: new Float32Array([0, 0, 0, 1, 0, NaN, 0, 1, 0])})', 'RangeError', /not finite.*\.$/],
    ['shadows.addMesh({positions: new Float32Array(9), identities: new Uint32Array(2)})', 'RangeError', /^identities of addMesh\(\) has 2 numbers for 3 vertices\.$/],
    ['mesh.deformed(new Float32Array(9))', 'RangeError', /\b3\b.*\b8\b.*\.$/],
    ['shadows.addCaster({})', 'TypeError', /^The mesh of addCaster\(\) is an Object instead of a Mesh\.$/],
    ['others.addCaster(mesh)', 'TypeError', /^The mesh of addCaster\(\) belongs to other shadows than these\.$/],
    ["shadows.addCaster(mesh, {nearCaps: 'none'})", 'RangeError', /^nearCaps of addCaster\(\) is "none" instead of /],
    ['shadows.addCaster(mesh, {inDepth: 1})', 'TypeError', /^inDepth of addCaster\(\) is 1 instead of true or false\.$/],
    ['shadows.addCaster(mesh, {transform: new Float32Array(12)})', 'RangeError', /^transform of addCaster\(\) has 12 numbers instead of 16\.$/],
    ['caster.setTransform([...Array(15).fill(0), NaN])', 'RangeError', /^The transform of a caster\[15\] is NaN, /],
    ['caster.setTransform(Array.from({length: 16}, (_, i) => i))', 'RangeError', /^The transform of a caster has the last row 3, 7, 11, 15 instead of 0, 0, 0, 1: /],
    ['caster.setTransform({elements: []})', 'TypeError', /^The transform of a caster is an Object instead of an array of 16 numbers\.$/],
    ["caster.visible = 'no'", 'TypeError', /^visible of a caster is "no" instead of true or false\.$/],
    ['caster.remove(); caster.setTransform(probe.things[0].pose)', 'Error', /^This caster was removed\.$/],
    ['mesh.remove(); shadows.addCaster(mesh)', 'Error', /^The mesh of addCaster\(\) was removed\.$/],
    ["shadows.addLight({type: 'area'})", 'RangeError', /^type of a light is "area" instead of /],
    ["shadows.addLight({type: 'point'})", 'TypeError', /^position of a point light is undefined instead of an array of 3 numbers\.$/],
    ["shadows.addLight({type: 'directional', direction: [0, 0, 0]})", 'RangeError', /^direction of a directional light is 0, 0, 0, /],
    ['light.set({range: -1})', 'RangeError', /^range of a light is -1, which is not within 0 and Infinity\.$/],
    ['light.remove(); light.bit', 'Error', /^This light was removed\.$/],
    ['shadows.render({...how, depth: null})', 'TypeError', /^depth of render\(\) is null instead of a GPUTexture\.$/],
    ["shadows.render({...how, depth: texture({format: 'depth16unorm'})})", 'RangeError', /is of depth16unorm instead of depth32float-stencil8, /],
    ["shadows.render({...how, depth: texture({usage: 16})})", 'RangeError', /cannot be read: make it with GPUTextureUsage\.TEXTURE_BINDING\.$/],
    ['shadows.render({...how, depth: texture({size: [4, 4, 2]})})', 'RangeError', /has 2 layers and 1 mip levels /],
    ['shadows.render({...how, depth: texture({sampleCount: 4})})', 'RangeError', /has 4 samples, but bits have one: createShadows\(device, \{masks: "shares"\}\)/],
    ['shadows.render({...how, reversed: false})', 'Error', /^The depth of projection is reversed.*set reversed to true, or exchange near and far\.$/],
    ['shadows.render({...how, view: how.view.map(v => 2 * v)})', 'Error', /^view is more than a rotation and a translation: .*\.$/],
    ['shadows.render({...how, projection: how.view.map(() => 0)})', 'Error', /^projection .*\.$/],
    ['shadows.render({...how, encoder: device})', 'TypeError', /^encoder of render\(\) is a GPUDevice instead of a GPUCommandEncoder\.$/],
    ['shadows.dispose(); shadows.render(how)', 'Error', /^(These shadows were disposed of|This view was removed)\.$/],
    ['shadows.dispose(); shadows.addMesh(probe.box)', 'Error', /^These shadows were disposed of\.$/],
    ['shadows.dispose(); shadows.dispose(); caster.setTransform(probe.things[0].pose)', 'Error', /^These shadows were disposed of\.$/],
];

claim('what cannot be is refused, each in one sentence', async visitor => {
    for (const [what, type, sentence] of refusals) {
        const said = await inScene(visitor, `async ({probe, device, shadows, things, how}) => {
            const {createShadows, featuresOf} = probe;
            const mesh = things.meshes.get(probe.box), caster = things.casters[0], light = things.lights[0];
            const texture = desc => device.createTexture({size: [4, 4], format: 'depth32float', usage: 20, ...desc});
            const others = ${what.includes('others') ? 'await createShadows(device)' : 'null'};
            try { await (async () => { ${what.replace(/([^;]*)$/, 'return $1')} })(); } catch (error) {
                return [error.constructor.name, error.message];
            }
            return ['nothing', ''];
        }`);
        assert.equal(said[0], type, `${what}: ${said[1]}`);
        assert.match(said[1], sentence, what);
        assert.equal(said[1].split('\n').length, 1, what);
    }
}, probe);

claim('a device without what is needed is one sentence, and one without depth clamping draws what it can', async visitor => {
    const said = await visitor.evaluate(`(async probe => {
        const said = {};
        try { await probe.createShadows(await probe.newDevice([])); } catch (error) { said.stencil = [error.code, error.message]; }
        const features = ['depth32float-stencil8'];
        said.infinite = (await probe.judge({features})).wrong;
        try { said.far = (await probe.judge({features, far: 60})).wrong; } catch (error) { said.far = [error.code, error.message]; }
        try { await probe.createShadows(await probe.newDevice(), {wasm: 'nowhere.wasm'}); } catch (error) { said.wasm = error.message; }
        return said;
    })(window.probe)`);
    assert.equal(said.stencil[0], 'unsupported');
    assert.match(said.stencil[1], /^This GPUDevice lacks depth32float-stencil8, .*featuresOf\(adapter\)\}\)\.$/);
    assert.equal(said.infinite, 0);
    assert.ok(said.far === 0 || said.far[0] === 'unsupported' && /lacks depth-clip-control.*\.$/.test(said.far[1]), JSON.stringify(said.far));
    assert.match(said.wasm, /^The WebAssembly of gnomon-shadows does not load from nowhere\.wasm: /);
    visitor.errors = visitor.errors.filter(text => !text.includes('nowhere.wasm'));
}, probe);

claim('the bridge imports what it was told, and refuses all else', async visitor => {
    const said = await visitor.evaluate(`(async probe => {
        const {Bridge} = await import('../node_modules/gnomon-shadows/bridge.js');
        const device = await probe.newDevice();
        const bridge = new Bridge(device, {adopted: true});
        const texture = device.createTexture({size: [8, 4], format: 'depth32float-stencil8', usage: 16});
        const number = bridge.adopt(texture);
        const desc = {label: 't', size: [8, 4], format: 'depth32float-stencil8', usage: 16, mipLevelCount: 1, sampleCount: 1, adopted: number};
        const answer = more => [bridge.create(1, 0, JSON.stringify({...desc, ...more})), bridge.error];
        const said = {right: answer({})[0], kept: bridge.objects.texture[0].handle === texture};
        bridge.destroy(1, 0);
        said.size = answer({size: [8, 8]});
        said.usage = answer({usage: 20});
        said.unknown = answer({adopted: 7});
        bridge.release(number);
        said.released = answer({});
        said.left = bridge.textures.length;
        said.alive = texture.gone !== true;
        return said;
    })(window.probe)`);
    assert.deepEqual([said.right, said.kept, said.left, said.alive], [0, true, 0, true]);
    for (const [name, sentence] of Object.entries({
        size: /^\[Texture "t"\] cannot be imported: it has 8 x 4 texels of depth32float-stencil8, .*, not 8 x 8 texels /,
        usage: /^\[Texture "t"\] cannot be imported: its usage is 16 and lacks some of 20 /,
        unknown: /^\[Texture "t"\] cannot be imported: the page has adopted no texture by the number 7\.$/,
        released: /adopted no texture by the number 0\.$/,
    })) {
        assert.equal(said[name][0], 1, name);
        assert.match(said[name][1], sentence);
    }
}, probe);

claim('its WebAssembly may come as bytes, and all of it may be in a worker', async visitor => {
    const [fromBytes, inWorker] = await visitor.evaluate(`(async probe => {
        const folder = new URL('../node_modules/gnomon-shadows/', location.href).href;
        const bytes = await (await fetch(folder + 'gnomon-shadows.wasm')).arrayBuffer();
        const whole = new Uint8Array(bytes.byteLength + 3);
        whole.set(new Uint8Array(bytes), 3);
        const shadows = await probe.createShadows(await probe.newDevice(), {wasm: whole.subarray(3)});
        const code = \`
            import {createShadows, featuresOf} from '\${folder}index.js';
            const adapter = await navigator.gpu.requestAdapter();
            const device = await adapter.requestDevice({requiredFeatures: featuresOf(adapter)});
            const shadows = await createShadows(device);
            shadows.addMesh({positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0])});
            const depth = device.createTexture({size: [8, 8], format: 'depth32float', usage: GPUTextureUsage.TEXTURE_BINDING});
            const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
            const {mask} = shadows.render({depth, view: identity, projection: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0], reversed: true});
            postMessage(mask.format);\`;
        const worker = new Worker(URL.createObjectURL(new Blob([code], {type: 'text/javascript'})), {type: 'module'});
        const said = await new Promise((resolve, reject) => {
            worker.onmessage = ({data}) => resolve(data);
            worker.onerror = ({message}) => reject(new Error(message));
        });
        worker.terminate();
        return [shadows.addMesh(probe.box).report.closed, said];
    })(window.probe)`);
    assert.equal(fromBytes, true);
    assert.equal(inWorker, 'r32uint');
}, probe);

claim('what was handed over may change, and what was handed out stays', async visitor => {
    const found = await inScene(visitor, `async ({probe, device, shadows, host, how, judged}) => {
        const found = {};
        // As three.js inverts a camera's pose: the last element is 1 but for a rounding.
        const {view} = how;
        how.view = Float64Array.from(view, (v, i) => i === 15 ? 1 - 2 ** -53 : v);
        found.inverse = await judged();
        how.view = view;
        const position = [0, 3, 0];
        const light = shadows.addLight({type: 'point', position});
        position[0] = NaN;
        light.set({range: 10});
        // An encoder that comes again after another one.
        const encoders = [device.createCommandEncoder(), device.createCommandEncoder()];
        for (const encoder of encoders) shadows.render({...how, encoder});
        try { shadows.render({...how, encoder: encoders[0]}); } catch (error) { found.again = error.message; }
        const shares = await probe.createShadows(device, {masks: 'shares'});
        const lamps = [0, 1, 2].map(x => shares.addLight({type: 'point', position: [x, 3, 0]}));
        const {masks} = shares.render(how);
        lamps[2].remove();
        found.same = masks.every((mask, i) => mask === shares.render(how).masks[i]) && masks.length === 3;
        lamps.push(shares.addLight({type: 'point', position: [2, 3, 0]}), shares.addLight({type: 'point', position: [3, 3, 0]}));
        found.more = shares.render(how).masks.length;
        found.kept = masks.length;
        shares.dispose();
        try { shares.render(how); } catch (error) { found.disposed = error.message; }
        return found;
    }`);
    assert.equal(found.inverse, 0);
    assert.match(found.again, /^This view is in that encoder already, /);
    assert.ok(found.same, 'masks that were handed out are others after a light went');
    assert.deepEqual([found.more, found.kept], [4, 3]);
    assert.equal(found.disposed, 'These shadows were disposed of.');
}, probe);

claim('what its guides have a shader ask is WGSL', async visitor => {
    const root = path.join(path.dirname(fileURLToPath(import.meta.url)), '../..');
    for (const guide of ['docs/web.md', 'apps/npm/package/README.md']) {
        const text = readFileSync(path.join(root, guide), 'utf8');
        const [, load] = /let shadowed = (textureLoad\(.*?\)\.r);/.exec(text);
        const [, question] = /^if \((.*)\) \{ … \}/m.exec(text);
        const [, name] = /textureLoad\((\w+)/.exec(load);
        const code = `@group(1) @binding(0) var ${name}: texture_2d<u32>;
            fn arrives(position: vec4f, lamp_bit: u32) -> bool { let shadowed = ${load}; return ${question}; }`;
        const said = await inPage(visitor, `async (probe, code) => {
            const device = await probe.newDevice();
            const {messages} = await device.createShaderModule({code}).getCompilationInfo();
            return messages.map(({message}) => message);
        }`, code);
        assert.deepEqual(said, [], guide);
    }
}, probe);

claim('two of them on one device do not disturb each other', async visitor => {
    assert.deepEqual(await inScene(visitor, `async ({probe, device, shadows, how, judged}) => {
        const second = await probe.createShadows(device, {capBias: null});
        const mesh = second.addMesh(probe.box);
        second.addCaster(mesh, {transform: probe.things[1].pose});
        second.addLight(probe.lights[1]);
        const other = async () => probe.judged(await probe.read(device, second.render(how).mask, Uint32Array), [1], [probe.lights[1]]).wrong;
        const found = [await judged(), await other(), await judged()];
        second.dispose();
        return [...found, await judged()];
    }`), [0, 0, 0, 0]);
}, probe);

claim(`memory is steady over ${frames} frames, and all is freed in the end`, async visitor => {
    const found = await inScene(visitor, `async ({probe, device, shadows, things, host, how}) => {
        const {alive} = probe;
        const at = [];
        const look = () => at.push([alive.objects, alive.memories.at(-1).buffer.byteLength]);
        for (let i = 0; i < ${frames}; ++i) {
            things.casters[3].setTransform(probe.things[3].pose.map((v, k) => k === 12 ? v + Math.sin(i / 7) : v));
            things.lights[0].set({position: [Math.cos(i / 9), 3.2, 1.7]});
            if (i % 10 === 0) {  // and some come and go
                things.casters.push(shadows.addCaster(things.meshes.get(probe.box), {transform: probe.things[2].pose}));
                things.casters.splice(2, 1)[0].remove();
                shadows.addMesh(probe.sheet).remove();
                things.lights.pop().remove();
                things.lights.push(shadows.addLight(probe.lights[2]));
            }
            shadows.render(how);
            if (i % 50 === 49) await device.queue.onSubmittedWorkDone();
            if (i === ${Math.floor(frames / 5)} || i === ${frames - 1}) look();
        }
        shadows.dispose();
        host.free();
        return {at, left: alive.objects};
    }`);
    assert.deepEqual(found.at[1], found.at[0]);
    assert.ok(found.at[0][0] > 5);
    assert.equal(found.left, 0);
    console.log(`        ${found.at[0][0]} buffers and textures, ${(found.at[0][1] / 2 ** 20).toFixed(1)} MiB of memory of WebAssembly`);
}, probe);

claim('a device that is lost is one sentence', async visitor => {
    const [sentence, said, code] = await inScene(visitor, `async ({device, shadows, how}) => {
        device.destroy();
        const sentence = await shadows.lost;
        try { shadows.render(how); } catch (error) { return [sentence, error.message, error.code]; }
        return [sentence, 'nothing', ''];
    }`);
    assert.match(sentence, /^The WebGPU device is lost \(destroyed\): .*\.$/);
    assert.equal(said, sentence);
    assert.equal(code, 'device-lost');
}, probe);

claim('the plain example draws and moves, wide and narrow', async visitor => {
    assert.equal(await visitor.evaluate('document.body.dataset.failed ?? ""'), '');
    await visitor.until('document.body.dataset.frames > 5');
    assert.equal(await visitor.evaluate("document.querySelector('p').textContent"), '');
    await visitor.keepPicture('plain.png');
    await visitor.page.call('Emulation.setDeviceMetricsOverride', {width: 390, height: 844, deviceScaleFactor: 1, mobile: true});
    const now = await visitor.evaluate('Number(document.body.dataset.frames)');
    await visitor.until(`document.body.dataset.frames > ${now + 3}`);
    assert.deepEqual(await visitor.evaluate("(c => [c.width, c.height])(document.querySelector('canvas'))"), [390, 844]);
    await visitor.keepPicture('plain-narrow.png');
}, {path: 'plain/', width: 960, height: 540});

/// Whether three.js is there, or comes.
function hasThree() {
    const site = option('--site');
    const there = () => existsSync(path.join(site, 'node_modules/three/build/three.webgpu.js'));
    if (!there()) spawnSync('npm', ['install', '--no-audit', '--no-fund'], {cwd: site, timeout: 120_000});
    return there();
}

/// Of places of three's picture: whether bits of the mask are what rays of three's own say, and how bright the floor is by
/// them. Places where those of the neighbours differ are left out.
const lookAtThree = `(async () => {
    const {camera, lights, mask, renderer, scene, shadows} = await import('./main.js');
    const THREE = await import('three');
    renderer.setAnimationLoop(null);
    const {device} = shadows;
    const texture = mask.sourceTexture;
    const {width, height} = texture;
    const bytesPerRow = Math.ceil(width * 4 / 256) * 256;
    const staging = device.createBuffer({size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ});
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({texture}, {buffer: staging, bytesPerRow}, [width, height]);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(GPUMapMode.READ);
    const bits = new Uint32Array(staging.getMappedRange());

    const casters = [];
    scene.traverse(mesh => { if (mesh.receiveShadow) casters.push(mesh); });
    for (const {material} of casters) material.side = THREE.DoubleSide;  // rays are to meet either side
    const ray = new THREE.Raycaster();
    const seen = (x, y) => {
        ray.near = 0;
        ray.far = Infinity;
        ray.setFromCamera(new THREE.Vector2(2 * x / width - 1, 1 - 2 * y / height), camera);
        const [hit] = ray.intersectObjects(casters, false);
        if (!hit) return null;
        let value = 0;
        for (const {light, guest} of lights) {
            const at = light.getWorldPosition(new THREE.Vector3());
            const way = light.isDirectionalLight ? at.clone().sub(light.target.getWorldPosition(new THREE.Vector3())) : at.clone().sub(hit.point);
            ray.set(hit.point, way.clone().normalize());
            ray.near = 1e-4;
            ray.far = light.isDirectionalLight ? Infinity : way.length();
            if (ray.intersectObjects(casters, false).length > 0) value |= 1 << guest.bit;
        }
        return {value, object: hit.object.id};
    };
    const counts = {wrong: [], judged: 0, shadowed: 0};
    for (let y = 3; y < height - 3; y += 7) {
        for (let x = 3; x < width - 3; x += 7) {
            const [at, ...around] = [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]].map(([dx, dy]) => seen(x + 0.5 + dx, y + 0.5 + dy));
            if (!at || around.some(other => other?.value !== at.value || other.object !== at.object)) continue;
            ++counts.judged;
            counts.shadowed += at.value !== 0;
            if (bits[y * bytesPerRow / 4 + x] !== at.value) counts.wrong.push([x, y, bits[y * bytesPerRow / 4 + x], at.value]);
        }
    }
    return counts;
})()`;

if (hasThree()) {
    claim('three.js draws with the mask, which is what its own rays say', async visitor => {
        assert.equal(await visitor.evaluate('document.body.dataset.failed ?? ""'), '');
        await visitor.until('document.body.dataset.frames > 3');
        await visitor.keepPicture('three.png');
        await visitor.page.call('Emulation.setDeviceMetricsOverride', {width: 390, height: 600, deviceScaleFactor: 1, mobile: true});
        const now = await visitor.evaluate('Number(document.body.dataset.frames)');
        await visitor.until(`document.body.dataset.frames > ${now + 3}`);
        await visitor.keepPicture('three-narrow.png');
        const {wrong, judged, shadowed} = await visitor.evaluate(lookAtThree);
        console.log(`        ${wrong.length} of ${judged} wrong, ${shadowed} in shadow`);
        assert.ok(judged > 800 && shadowed > 100, `${shadowed} of ${judged}`);
        // SwiftShader dots the sides of volumes that are seen edge-on (docs/hard-cases.md, "On another rasteriser").
        assert.ok(wrong.length <= judged / 500, JSON.stringify(wrong));
    }, {path: 'three/', width: 640, height: 360});
} else {
    console.log('skipped the example with three.js: npm does not bring it (is there a network?)');
}

check();
