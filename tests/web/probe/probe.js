// SPDX-License-Identifier: MIT
//
// A host of gnomon-shadows with a scene of boxes and an open sheet, which draws its depth in whatever way it is told and holds
// the masks against truth.js. package.mjs calls it as window.probe.
import {truth, placed} from './truth.js';

const width = 120, height = 90;
const near = 0.1;
const fovy = 0.8;

// ---- What is alive: of the device, and of WebAssembly.

const alive = {objects: 0, made: 0, memories: []};
const instantiateStreaming = WebAssembly.instantiateStreaming;
WebAssembly.instantiateStreaming = async (...args) => {
    const result = await instantiateStreaming(...args);
    alive.memories.push(Object.values(result.instance.exports).find(e => e instanceof WebAssembly.Memory));
    return result;
};
const {clipFromLocal, createShadows, featuresOf, positionWGSL, ...others} = await import('gnomon-shadows');

/// Counts buffers and textures of a device, which have to be destroyed, and all things that are made.
function watched(device) {
    for (const kind of ['Buffer', 'Texture', 'RenderPipeline', 'ShaderModule', 'BindGroup', 'BindGroupLayout', 'Sampler']) {
        const make = device[`create${kind}`].bind(device);
        device[`create${kind}`] = desc => {
            const object = make(desc);
            ++alive.made;
            if (object.destroy) {
                ++alive.objects;
                const destroy = object.destroy.bind(object);
                object.destroy = () => {
                    if (!object.gone) --alive.objects;
                    object.gone = true;
                    destroy();
                };
            }
            return object;
        };
    }
    return device;
}

/// `features`: of all that gnomon would ask for, those.
async function newDevice(features = undefined) {
    const adapter = await navigator.gpu.requestAdapter();
    const requiredFeatures = featuresOf(adapter).filter(name => features?.includes(name) ?? true);
    const device = watched(await adapter.requestDevice({requiredFeatures}));
    device.addEventListener('uncapturederror', ({error}) => console.error(error.message));
    return device;
}

// ---- The scene.

const box = {
    positions: new Float32Array([0, 1, 2, 3, 4, 5, 6, 7].flatMap(i => [i & 1, i >> 1 & 1, i >> 2].map(bit => bit - 0.5))),
    indices: new Uint32Array([0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6]),
};
const sheet = {positions: new Float32Array([-0.5, 0, -0.5, 0.5, 0, -0.5, 0.5, 0, 0.5, -0.5, 0, 0.5]), indices: new Uint16Array([0, 2, 1, 0, 3, 2])};
function posed([x, y, z], [w, h, d], turn = 0, tilt = 0) {
    const c = Math.cos(turn), s = Math.sin(turn), k = Math.cos(tilt), q = Math.sin(tilt);
    return [w * c, 0, -w * s, 0, h * s * q, h * k, h * c * q, 0, d * s * k, -d * q, d * c * k, 0, x, y, z, 1].map(Math.fround);
}
const things = [
    {shape: box, pose: posed([0, -0.1, 0], [14, 0.2, 14])},
    {shape: box, pose: posed([-0.6, 1.2, -0.4], [0.5, 2.4, 0.5], 0.3)},
    {shape: box, pose: posed([1.9, 0.5, 0.5], [1, 1, 1], 0.6)},
    {shape: box, pose: posed([-2.3, 0.6, 1.1], [0.7, 0.7, 1.6], -0.5, 0.4)},
    {shape: box, pose: posed([0.4, 1.7, 1.2], [1.1, -0.2, 1.1], 0.2, 0.3)},  // mirrored
    {shape: sheet, pose: posed([1.2, 1.6, -0.6], [0.9, 1, 1.2], 0.4, 0.5)},
];
const lights = [
    {type: 'point', position: [0.9, 3.2, 1.7]},
    {type: 'directional', direction: [-0.48, -0.6, -0.64]},
    {type: 'spot', position: [-2.6, 2.2, 3.1]},
];
// A camera that looks down on it, rotated about x alone.
const eye = [0.3, 4.0, 6.2];
const pitch = -0.52;
const view = [1, 0, 0, 0, 0, Math.cos(pitch), -Math.sin(pitch), 0, 0, Math.sin(pitch), Math.cos(pitch), 0, 0, 0, 0, 1];
view[12] = -eye[0];
view[13] = -(view[5] * eye[1] + view[9] * eye[2]);
view[14] = -(view[6] * eye[1] + view[10] * eye[2]);
const f = 1 / Math.tan(fovy / 2);

function projectionOf({reversed, far}) {
    const [a, b] = far ? [far / (near - far), near * far / (near - far)] : [-1, -near];
    return [f * height / width, 0, 0, 0, 0, f, 0, 0, 0, 0, reversed ? -1 - a : a, -1, 0, 0, reversed ? -b : b, 0];
}

function rays(x, y) {
    const d = [(2 * x / width - 1) * width / height / f, (1 - 2 * y / height) / f, -1];
    return {eye, way: [d[0], view[5] * d[1] + view[6] * d[2], view[9] * d[1] + view[10] * d[2]]};
}

const known = new Map();
/// Of the casters of these places, at an offset within each pixel.
function truthOf(places, of, offset = [0.5, 0.5], band = 1 / 8) {
    const key = JSON.stringify([places, of, offset, band]);
    if (!known.has(key)) {
        const all = things.map(({shape, pose}) => placed(shape.positions, shape.indices, pose));
        known.set(key, truth({triangles: all.flat(), casters: places.flatMap(i => all[i]), lights: of, width, height, rays, offset, band}));
    }
    return known.get(key);
}

// ---- The host's depth.

/// By gnomon's function and matrix, or by three matrices in single precision, as shaders mostly do.
const shader = `
${positionWGSL}
struct Thing { clip: mat4x4f, projection: mat4x4f, view: mat4x4f, model: mat4x4f }
@group(0) @binding(0) var<storage, read> things: array<Thing>;
@vertex fn exact(@location(0) p: vec3f, @builtin(instance_index) i: u32) -> @invariant @builtin(position) vec4f {
    return clip_position(things[i].clip, vec4f(p, 1));
}
@vertex fn usual(@location(0) p: vec3f, @builtin(instance_index) i: u32) -> @invariant @builtin(position) vec4f {
    return things[i].projection * things[i].view * things[i].model * vec4f(p, 1);
}`;

function drawDepth(device, encoder, {format, samples, reversed, far, exact, usage}) {
    const depth = device.createTexture({label: 'host depth', size: [width, height], format, sampleCount: samples, usage});
    const module = device.createShaderModule({code: shader});
    const layout = device.createBindGroupLayout(
        {entries: [{binding: 0, visibility: GPUShaderStage.VERTEX, buffer: {type: 'read-only-storage'}}]});
    const pipeline = device.createRenderPipeline({
        layout: device.createPipelineLayout({bindGroupLayouts: [layout]}),
        vertex: {module, entryPoint: exact ? 'exact' : 'usual',
                 buffers: [{arrayStride: 12, attributes: [{shaderLocation: 0, offset: 0, format: 'float32x3'}]}]},
        primitive: {unclippedDepth: device.features.has('depth-clip-control')},
        depthStencil: {format, depthWriteEnabled: true, depthCompare: reversed ? 'greater' : 'less'},
        multisample: {count: samples},
    });
    const buffer = (data, kind) => {
        const made = device.createBuffer({size: data.byteLength + 3 & ~3, usage: kind | GPUBufferUsage.COPY_DST, mappedAtCreation: true});
        new data.constructor(made.getMappedRange(), 0, data.length).set(data);
        made.unmap();
        return made;
    };
    const projection = projectionOf({reversed, far});
    const data = new Float32Array(things.length * 64);
    things.forEach(({pose}, i) => {
        data.set(clipFromLocal(projection, view, pose), 64 * i);
        [projection, view, pose].forEach((m, k) => data.set(m, 64 * i + 16 + 16 * k));
    });
    const mine = [buffer(data, GPUBufferUsage.STORAGE)];
    const stencil = format.includes('stencil8') ? {stencilLoadOp: 'clear', stencilStoreOp: 'store', stencilClearValue: 77} : {};
    const pass = encoder.beginRenderPass({colorAttachments: [], depthStencilAttachment: {
        view: depth.createView(), depthLoadOp: 'clear', depthStoreOp: 'store', depthClearValue: reversed ? 0 : 1, ...stencil}});
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({layout, entries: [{binding: 0, resource: {buffer: mine[0]}}]}));
    things.forEach(({shape}, i) => {
        mine.push(buffer(shape.positions, GPUBufferUsage.VERTEX), buffer(shape.indices, GPUBufferUsage.INDEX));
        pass.setVertexBuffer(0, mine.at(-2));
        pass.setIndexBuffer(mine.at(-1), shape.indices instanceof Uint16Array ? 'uint16' : 'uint32');
        pass.drawIndexed(shape.indices.length, 1, 0, 0, i);
    });
    pass.end();
    return {depth, projection, free: () => [depth, ...mine].forEach(thing => thing.destroy())};
}

async function read(device, texture, Type, aspect = 'all') {
    const bytesPerRow = 512;
    const staging = device.createBuffer({size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ});
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({texture, aspect}, {buffer: staging, bytesPerRow}, [width, height]);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(GPUMapMode.READ);
    const rows = new Type(staging.getMappedRange());
    const pitch = rows.length / height;
    const values = Array.from({length: width * height}, (_, i) => rows[Math.floor(i / width) * pitch + i % width]);
    staging.destroy();
    return values;
}

function fill(shadows, {nearCaps = 'facing'} = {}) {
    const meshes = new Map([box, sheet].map(shape => [shape, shadows.addMesh(shape)]));
    return {
        meshes,
        // A sheet has no side that light does not reach.
        casters: things.map(({shape, pose}) => shadows.addCaster(
            meshes.get(shape), {transform: pose, nearCaps: shape === sheet ? 'facing' : nearCaps})),
        lights: lights.map(light => shadows.addLight(light)),
    };
}

const everything = things.map((_, i) => i);

/// How many pixels of a mask of bits are wrong, outside of the band.
function judged(bits, places = everything, of = lights) {
    const counts = {wrong: 0, judged: 0, shadowed: 0};
    truthOf(places, of).forEach((at, i) => {
        if (at === null || at.which < 0) return;
        ++counts.judged;
        counts.wrong += bits[i] !== at.bits;
        counts.shadowed += at.bits !== 0;
    });
    return counts;
}

// As WebGPU has them.
const samplePlaces = {1: [[0.5, 0.5]], 4: [[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]};

/// The same of shares of a pixel's samples, one mask a light.
function judgedShares(masks, samples) {
    const counts = {wrong: 0, judged: 0, shadowed: 0};
    const truths = samplePlaces[samples].map(offset => truthOf(everything, lights, offset, samples > 1 ? 3 / 16 : 1 / 8));
    for (let i = 0; i < width * height; ++i) {
        const at = truths.map(truth => truth[i]);
        if (at.some(sample => sample === null || sample.which < 0)) continue;
        const shares = lights.map((_, l) => at.filter(({bits}) => (bits >>> l & 1) !== 0).length / samples);
        ++counts.judged;
        // Half of 255 may be rounded either way.
        counts.wrong += masks.some((mask, l) => Math.abs(mask[i] - 255 * shares[l]) >= 1);
        counts.shadowed += shares.some(share => share > 0);
    }
    return counts;
}

const {RENDER_ATTACHMENT, TEXTURE_BINDING, COPY_SRC} = GPUTextureUsage;

window.probe = {
    alive, width, height, view, things, lights, sheet, box, others, newDevice, drawDepth, read, fill, judged, projectionOf,
    createShadows, featuresOf, everything,

    /// A picture in a way of the host's, judged.
    async judge({format = 'depth32float', samples = 1, reversed = true, far = 0, exact = true, averted = false, keepStencil = false,
                 usage = RENDER_ATTACHMENT | TEXTURE_BINDING, masks = 'bits', inEncoder = false, features = undefined}) {
        const device = await newDevice(features);
        const shadows = await createShadows(device, {masks, ...(exact ? {capBias: null} : {})});
        fill(shadows, {nearCaps: averted ? 'averted' : 'facing'});
        const encoder = device.createCommandEncoder();
        if (samples === 1) usage |= COPY_SRC;
        const host = drawDepth(device, encoder, {format, samples, reversed, far, exact, usage});
        if (!inEncoder) device.queue.submit([encoder.finish()]);
        const drawn = shadows.render({
            depth: host.depth, view, projection: host.projection, reversed, keepStencil, ...(inEncoder ? {encoder} : {})});
        if (inEncoder) device.queue.submit([encoder.finish()]);
        const counts = masks === 'bits' ? judged(await read(device, drawn.mask, Uint32Array))
                                        : judgedShares(
                                            await Promise.all(drawn.masks.map(mask => read(device, mask, Uint8Array))), samples);
        if (format.includes('stencil8') && samples === 1) {
            counts.stencil = [...new Set(await read(device, host.depth, Uint8Array, 'stencil-only'))];
        }
        shadows.dispose();
        host.free();
        device.destroy();
        return {...counts, stats: drawn.stats};
    },
};
document.body.dataset.frames = 1;
