// SPDX-License-Identifier: MIT
//
// gnomon-shadows: exact hard shadows for a page's own WebGPU renderer. index.d.ts says what each thing is, and what fails. The
// work is done by gnomon's shadow system and light masks, compiled to WebAssembly (apps/npm/shadows.hpp): what is here looks
// at arguments, keeps textures and hands on numbers. It draws no scene and shades nothing.
import * as check from './arguments.js';
import {Bridge} from './bridge.js';
import {countedFormat, DepthCopy, takenFormats} from './depth_copy.js';
import createModule from './gnomon-shadows.mjs';

export {clipFromLocal, positionWGSL} from './position.js';

export const requiredFeatures = Object.freeze([countedFormat]);
export const optionalFeatures = Object.freeze(['depth-clip-control']);

const maxLights = 32;
const usualCapBias = {constant: 4, slopeScale: 1 / 64};
// As gnomon::ErrorCode.
const codes = ['invalid-input', 'validation', 'unsupported', 'out-of-memory', 'device-lost', 'io', 'internal'];
// As gnomon_report() and gnomon_stats() put them.
const reportNames = ['triangles', 'vertices', 'weldedVertices', 'edges', 'components', 'closedComponents', 'boundaryEdges',
                     'nonManifoldEdges', 'inconsistentEdges', 'unbalancedEdges', 'degenerateFaces'];
const statNames = ['casters', 'pairs', 'pairsCulled', 'pairsHidden', 'pairsRedetected', 'pairsReused', 'depthPassPairs',
                   'depthFailPairs', 'silhouetteEdges', 'detectMs', 'buildMs', 'drawCalls', 'uploadedBytes'];
// Names of the core's that are others here.
const translations = [[/HostConventions::reversed/g, 'reversed'], [/view_from_world/g, 'view'], [/clip_from_view/g, 'projection'],
                      [/HostConventions::depth/g, 'the range of depth, 0 to 1,'],
                      [/unclipped depth/g, 'depth-clip-control']];

export function featuresOf(adapter) {
    if (typeof adapter?.requestDevice !== 'function') {
        throw new TypeError(`featuresOf() takes a GPUAdapter, not ${check.words(adapter)}.`);
    }
    for (const feature of requiredFeatures) {
        if (!adapter.features.has(feature)) {
            throw failure('unsupported', `This GPUAdapter lacks ${feature}, in which shadow volumes are counted.`);
        }
    }
    return [...requiredFeatures, ...optionalFeatures.filter(feature => adapter.features.has(feature))];
}

export async function createShadows(device, options = {}) {
    const place = 'createShadows()';
    check.device(device, place);
    const {masks = 'bits', capBias = usualCapBias, wasm = new URL('gnomon-shadows.wasm', import.meta.url)} =
        check.options(options, ['masks', 'capBias', 'wasm'], place);
    if (masks !== 'bits' && masks !== 'shares') {
        throw new RangeError(`masks of ${place} is ${check.words(masks)} instead of "bits" or "shares".`);
    }
    const bias = capBias === null ? {constant: 0, slopeScale: 0}
                                  : check.options(capBias, ['constant', 'slopeScale'], `capBias of ${place}`);
    check.number(bias.constant, `capBias.constant of ${place}`, {min: 0, max: 2 ** 20});
    if (!Number.isInteger(bias.constant)) throw new RangeError(`capBias.constant of ${place} is ${bias.constant} instead of a whole number.`);
    check.number(bias.slopeScale, `capBias.slopeScale of ${place}`, {min: 0, max: 2 ** 20});
    for (const feature of requiredFeatures) {
        if (!device.features.has(feature)) {
            throw failure('unsupported', `This GPUDevice lacks ${feature}, in which shadow volumes are counted: ask for it, ` +
                          'by requestDevice({requiredFeatures: featuresOf(adapter)}).');
        }
    }
    const core = new Core(device, await load(device, wasm));
    core.call('gnomon_start', bias.constant, bias.slopeScale);
    return new Shadows(core, masks === 'bits');
}

function failure(code, sentence) {
    const error = code === 'invalid-input' ? new RangeError(sentence) : new Error(sentence);
    error.code = code;
    return error;
}

/// A module of its own, with memory of its own.
async function load(device, wasm) {
    const bytes = wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm);
    if (!bytes && typeof wasm !== 'string' && !(wasm instanceof URL)) {
        throw new TypeError(`wasm of createShadows() is ${check.words(wasm)} instead of a URL or the bytes of gnomon-shadows.wasm.`);
    }
    const said = [];
    let loaded = false;
    try {
        const module = await createModule({
            gnomonBridge: new Bridge(device, {adopted: true}),
            ...(bytes ? {wasmBinary: new Uint8Array(wasm.buffer ?? wasm, wasm.byteOffset ?? 0, wasm.byteLength)}
                      : {locateFile: () => String(wasm)}),
            printErr: text => { loaded ? console.error(text) : said.push(text); },
        });
        loaded = true;
        return module;
    } catch (error) {
        throw failure('internal', `The WebAssembly of gnomon-shadows does not load from ${bytes ? 'the bytes that were given' : wasm}: ` +
                      `${said[0] ?? error.message}`);
    }
}

/// The module, until it is disposed of.
class Core {
    constructor(device, module) {
        this.device = device;
        this.module = module;
        this.bridge = module.gnomonBridge;
        this.doubles = module._gnomon_doubles() / 8;
    }

    /// Where what comes from C++ is, and what goes there.
    memory() {
        this.alive();
        return this.module.HEAPF64;
    }

    alive() {
        if (!this.module) throw new Error('These shadows were disposed of.');
        if (this.bridge.lost) throw failure('device-lost', this.bridge.lost);
    }

    /// An exported function; throws the sentence of its failure.
    call(name, ...args) {
        this.alive();
        const answer = this.module[`_${name}`](...args);
        if (answer < 0) {
            const sentence = this.module.UTF8ToString(this.module._gnomon_sentence());
            throw failure(codes[this.module._gnomon_code()] ?? 'internal',
                          translations.reduce((text, [from, to]) => text.replace(from, to), sentence));
        }
        return answer;
    }

    /// One that does nothing where it is too late: to remove what is gone is no mistake.
    release(name, number) {
        if (this.module) this.module[`_${name}`](number);
    }

    /// `use` with places of copies of arrays in the module's memory; null has the place 0.
    with(arrays, use) {
        this.alive();
        const places = [];
        try {
            for (const array of arrays) {
                const place = array === null ? 0 : this.module._malloc(Math.max(array.byteLength, 1));
                if (array !== null && place === 0) {
                    throw failure('out-of-memory', `The memory of gnomon's WebAssembly module has no room for ${array.byteLength} bytes.`);
                }
                places.push(place);
            }
            // After the last of them, since the memory may have grown.
            arrays.forEach((array, i) => {
                if (array !== null) {
                    this.module.HEAPU8.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), places[i]);
                }
            });
            return use(...places);
        } finally {
            for (const place of places) {
                if (place !== 0) this.module._free(place);
            }
        }
    }

    put(matrix, at = 0) { this.memory().set(matrix, this.doubles + at); }

    named(names) {
        const {HEAPF64} = this.module;
        return Object.fromEntries(names.map((name, i) => [name, HEAPF64[this.doubles + i]]));
    }
}

/// What has a number in a core, until it is removed.
class Numbered {
    #core;
    #number;

    constructor(core, number) {
        this.#core = core;
        this.#number = number;
    }

    get removed() { return this.#number === null || !this.#core.module; }

    /// The core, and the number; `what` names the thing where it is gone.
    static of(thing, what) {
        if (thing.#number === null) throw new Error(`${what} was removed.`);
        return {core: thing.#core, number: thing.#number};
    }

    /// The number of what was handed over to `core` at `place`.
    static handed(thing, kind, core, place) {
        if (!(thing instanceof kind)) throw new TypeError(`${place} is ${check.words(thing)} instead of a ${kind.name}.`);
        if (thing.#core !== core) throw new TypeError(`${place} belongs to other shadows than these.`);
        return Numbered.of(thing, place).number;
    }

    /// Forgets it: the number, or null where that was done before.
    static leave(thing) {
        const number = thing.#number;
        thing.#number = null;
        return {core: thing.#core, number};
    }
}

class Mesh extends Numbered {
    constructor(core, number) {
        super(core, number);
        core.call('gnomon_report', number);
        const report = core.named(reportNames);
        this.report = Object.freeze({
            ...report, closed: report.components > 0 && report.closedComponents === report.components,
        });
    }

    deformed(positions) {
        const {core, number} = Numbered.of(this, 'This mesh');
        check.positions(positions, 'positions of deformed()');
        return new Mesh(core, core.with([positions],
                                        place => core.call('gnomon_add_deformed', number, place, positions.length / 3)));
    }

    remove() {
        const {core, number} = Numbered.leave(this);
        if (number !== null) core.release('gnomon_remove_mesh', number);
    }
}

class Caster extends Numbered {
    #visible;
    #bits;  // but for visibility, as main.cpp has them

    constructor(core, number, visible, bits) {
        super(core, number);
        this.#visible = visible;
        this.#bits = bits;
    }

    setTransform(transform) {
        const {core, number} = Numbered.of(this, 'This caster');
        core.put(check.pose(transform, 'The transform of a caster'));
        core.call('gnomon_place', number);
    }

    setMesh(mesh) {
        const {core, number} = Numbered.of(this, 'This caster');
        core.call('gnomon_change_mesh', number, Numbered.handed(mesh, Mesh, core, 'The mesh of a caster'));
    }

    get visible() { return this.#visible; }
    set visible(visible) {
        const {core, number} = Numbered.of(this, 'This caster');
        this.#visible = check.boolean(visible, 'visible of a caster');
        core.call('gnomon_change', number, (visible ? 1 : 0) | this.#bits);
    }

    remove() {
        const {core, number} = Numbered.leave(this);
        if (number !== null) core.release('gnomon_remove_caster', number);
    }
}

const lightOptions = ['type', 'position', 'direction', 'range'];

class Light extends Numbered {
    #is = {type: 'point'};
    #bits;

    constructor(core, bit, bits) {
        super(core, bit);
        this.#bits = bits;
    }

    get bit() { return Numbered.of(this, 'This light').number; }

    set(options) {
        const {core, number} = Numbered.of(this, 'This light');
        const is = {...this.#is, ...check.options(options, lightOptions, 'A light')};
        if (!['point', 'spot', 'directional'].includes(is.type)) {
            throw new RangeError(`type of a light is ${check.words(is.type)} instead of "point", "spot" or "directional".`);
        }
        const directional = is.type === 'directional';
        const [x, y, z] = check.vector(directional ? is.direction : is.position,
                                       `${directional ? 'direction' : 'position'} of a ${is.type} light`);
        if (directional && x === 0 && y === 0 && z === 0) {
            throw new RangeError('direction of a directional light is 0, 0, 0, which leads nowhere.');
        }
        const range = is.range ?? Infinity;
        check.number(range, 'range of a light', {min: 0});
        const s = directional ? -1 : 1;
        core.call('gnomon_set_light', number, s * x, s * y, s * z, directional ? 0 : 1, Number.isFinite(range) ? range : -1);
        this.#is = {...is, [directional ? 'direction' : 'position']: [x, y, z]};  // the caller's array may change
    }

    remove() {
        const {core, number} = Numbered.leave(this);
        if (number === null) return;
        this.#bits.delete(number);
        core.release('gnomon_remove_light', number);
    }
}

const renderOptions = ['depth', 'view', 'projection', 'reversed', 'encoder', 'keepStencil'];

/// The host's depth, and whether volumes are counted in it or in a copy.
function depthOf(depth, keepStencil, bits) {
    if (typeof depth?.createView !== 'function' || !depth.format) {
        throw new TypeError(`depth of render() is ${check.words(depth)} instead of a GPUTexture.`);
    }
    const name = `depth of render() [GPUTexture ${JSON.stringify(depth.label)}]`;
    if (!takenFormats.includes(depth.format)) {
        throw new RangeError(`${name} is of ${depth.format} instead of ${takenFormats.join(', ')}.`);
    }
    if (depth.dimension !== '2d' || depth.depthOrArrayLayers !== 1 || depth.mipLevelCount !== 1) {
        throw new RangeError(`${name} has ${depth.depthOrArrayLayers} layers and ${depth.mipLevelCount} mip levels of dimension ` +
                             `${depth.dimension} instead of one of dimension 2d.`);
    }
    if (bits && depth.sampleCount > 1) {
        throw new RangeError(`${name} has ${depth.sampleCount} samples, but bits have one: ` +
                             'createShadows(device, {masks: "shares"}) gives each light its share of them.');
    }
    const direct = depth.format === countedFormat && !keepStencil && (depth.usage & GPUTextureUsage.RENDER_ATTACHMENT) !== 0;
    if (!direct && (depth.usage & GPUTextureUsage.TEXTURE_BINDING) === 0) {
        throw new RangeError(`${name} cannot be read: make it with GPUTextureUsage.TEXTURE_BINDING` +
                             (depth.format === countedFormat ? ', or let its stencil be used (keepStencil: false).' : '.'));
    }
    return direct;
}

class View extends Numbered {
    #bits;
    #lights;  // bits that are given
    #views;   // all there are
    #target = null;
    #encoders = new WeakSet();  // of the host's: what is uploaded for one is there once

    constructor(core, bits, lights, views) {
        super(core, 0);
        this.#bits = bits;
        this.#lights = lights;
        this.#views = views.add(this);
    }

    render(options) {
        const {core} = Numbered.of(this, 'This view');
        const {depth, view, projection, reversed = false, encoder = null, keepStencil = false} =
            check.options(options, renderOptions, 'render()');
        check.matrix(view, 'view of render()');
        check.matrix(projection, 'projection of render()');
        check.boolean(reversed, 'reversed of render()');
        check.encoder(encoder, 'encoder of render()');
        core.alive();
        const direct = depthOf(depth, check.boolean(keepStencil, 'keepStencil of render()'), this.#bits);
        if (encoder && this.#encoders.has(encoder)) {
            throw new Error('This view is in that encoder already, and what is uploaded for it is there once: submit it first, or ' +
                            'render another view (addView()).');
        }
        const target = this.#targetFor(core, depth, direct, reversed);
        const commands = encoder ?? core.device.createCommandEncoder({label: 'gnomon'});
        target.copy?.record(commands, depth);
        core.put(view);
        core.put(projection, 16);
        core.bridge.encoder = commands;
        try {
            core.call('gnomon_render', target.number);
        } finally {
            core.bridge.encoder = null;
        }
        if (!encoder) core.device.queue.submit([commands.finish()]);
        if (encoder) this.#encoders.add(encoder);
        core.call('gnomon_stats');
        return {mask: this.mask, masks: this.masks, stats: core.named(statNames)};
    }

    get mask() { return this.#bits ? this.masks[0] ?? null : null; }
    get masks() { return [...this.#target?.masks ?? []]; }

    #targetFor(core, depth, direct, reversed) {
        const {width, height, sampleCount} = depth;
        const t = this.#target;
        // As many as there ever were lights: what the host has bound stays.
        const count = this.#bits ? 1 : Math.max(1, t?.masks.length ?? 0, ...[...this.#lights].map(bit => bit + 1));
        if (t && t.width === width && t.height === height && t.sampleCount === sampleCount && t.reversed === reversed &&
            t.masks.length === count && t.direct === (direct ? depth : null)) {
            return t;
        }
        // A mask that fits stays the host's.
        const kept = t && t.width === width && t.height === height ? t.masks.splice(0) : [];
        this.#drop(core);
        const target = {width, height, sampleCount, reversed, direct: direct ? depth : null, masks: kept, number: null};
        target.copy = direct ? null : new DepthCopy(core.device, depth);
        while (target.masks.length < count) {
            target.masks.push(core.device.createTexture({
                label: 'gnomon mask', size: [width, height], format: this.#bits ? 'r32uint' : 'r8unorm',
                usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_SRC,
            }));
        }
        this.#target = target;
        const adopted = [target.copy?.texture ?? depth, ...target.masks].map(texture => core.bridge.adopt(texture));
        try {
            target.number = core.with([new Uint32Array(adopted.slice(1))], masks => core.call(
                'gnomon_add_view', adopted[0], width, height, sampleCount, reversed, this.#bits, masks, count));
        } catch (error) {
            this.#drop(core);
            throw error;
        } finally {
            for (const number of adopted.toReversed()) core.bridge.release(number);
        }
        return target;
    }

    #drop(core) {
        const target = this.#target;
        this.#target = null;
        if (!target) return;
        if (target.number !== null) core.release('gnomon_remove_view', target.number);
        target.copy?.destroy();
        for (const mask of target.masks) mask.destroy();
    }

    remove() {
        const {core, number} = Numbered.leave(this);
        if (number === null) return;
        this.#views.delete(this);
        this.#drop(core);
    }
}

class Shadows {
    #core;
    #bits;
    #lights = new Set();
    #views = new Set();
    #first;

    constructor(core, bits) {
        this.#core = core;
        this.#bits = bits;
        this.#first = this.addView();
        this.lost = core.device.lost.then(() => core.bridge.lost);
        this.features = Object.freeze({
            farPlanes: core.device.features.has('depth-clip-control'),
        });
    }

    get device() { return this.#core.device; }

    addMesh(options) {
        const {positions, indices, identities} = check.options(options, ['positions', 'indices', 'identities'], 'addMesh()');
        check.positions(positions, 'positions of addMesh()');
        const vertices = positions.length / 3;
        const triples = check.indices(indices, vertices, 'indices of addMesh()');
        const same = check.identities(identities, vertices, 'identities of addMesh()');
        const core = this.#core;
        return new Mesh(core, core.with([positions, triples, same], (p, i, s) => core.call(
            'gnomon_add_mesh', p, vertices, i, triples.length, s)));
    }

    addCaster(mesh, options = {}) {
        const core = this.#core;
        const number = Numbered.handed(mesh, Mesh, core, 'The mesh of addCaster()');
        const {transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], visible = true, inDepth = true, nearCaps = 'facing'} =
            check.options(options, ['transform', 'visible', 'inDepth', 'nearCaps'], 'addCaster()');
        if (nearCaps !== 'facing' && nearCaps !== 'averted') {
            throw new RangeError(`nearCaps of addCaster() is ${check.words(nearCaps)} instead of "facing" or "averted".`);
        }
        const bits = (check.boolean(inDepth, 'inDepth of addCaster()') ? 2 : 0) | (nearCaps === 'averted' ? 4 : 0);
        check.boolean(visible, 'visible of addCaster()');
        core.put(check.pose(transform, 'transform of addCaster()'));
        return new Caster(core, core.call('gnomon_add_caster', number, (visible ? 1 : 0) | bits), visible, bits);
    }

    addLight(options) {
        this.#core.alive();
        let bit = 0;
        while (this.#lights.has(bit)) ++bit;
        if (bit === maxLights) throw new RangeError(`There are ${maxLights} lights already, as many as a mask has bits.`);
        const light = new Light(this.#core, bit, this.#lights);
        light.set(options);
        this.#lights.add(bit);
        return light;
    }

    addView() {
        this.#core.alive();
        return new View(this.#core, this.#bits, this.#lights, this.#views);
    }

    render(options) {
        this.#core.alive();
        return this.#first.render(options);
    }

    dispose() {
        for (const view of [...this.#views]) view.remove();
        const core = this.#core;
        if (!core.module) return;
        core.module._gnomon_stop();
        core.module = null;
    }
}

export {Caster, Light, Mesh, Shadows, View};
