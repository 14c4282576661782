// SPDX-License-Identifier: MIT
//
// Shadows in a page's own renderer: a plain program of WebGPU with some boxes, a lamp and a sun. It draws its depth; gnomon
// counts shadow volumes against that and writes a texture of bits, one a light; the page shades, and its shader looks the bits
// up. What gnomon adds is marked by "guest".
import {clipFromLocal, createShadows, featuresOf, positionWGSL} from 'gnomon-shadows';  // guest

const shader = `
${positionWGSL}  // guest: clip_position(), so that depth and shadow volumes have the same bits

struct Thing { clip_from_local: mat4x4f, world_from_local: mat4x4f, albedo: vec4f }
struct Lights { lamp: vec4f, to_sun: vec4f }
@group(0) @binding(0) var<storage, read> things: array<Thing>;
@group(0) @binding(1) var<uniform> lights: Lights;
@group(1) @binding(0) var shadows: texture_2d<u32>;  // guest: bit l is set where light l does not arrive

struct Corner {
    @invariant @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) @interpolate(flat) thing: u32,
}

@vertex fn vertex(@location(0) position: vec3f, @builtin(instance_index) i: u32) -> Corner {
    let p = vec4f(position, 1);
    return Corner(clip_position(things[i].clip_from_local, p), (things[i].world_from_local * p).xyz, i);
}

@fragment fn fragment(in: Corner) -> @location(0) vec4f {
    let normal = normalize(cross(dpdy(in.world), dpdx(in.world)));
    let shadowed = textureLoad(shadows, vec2u(in.clip.xy), 0).r;  // guest
    var light = vec3f(0.03, 0.04, 0.06);
    if ((shadowed & 1) == 0) {  // guest
        let to_lamp = lights.lamp.xyz - in.world;
        light += vec3f(9, 7, 4) * max(dot(normal, normalize(to_lamp)), 0) / dot(to_lamp, to_lamp);
    }
    if ((shadowed & 2) == 0) {  // guest
        light += vec3f(0.20, 0.24, 0.30) * max(dot(normal, lights.to_sun.xyz), 0);
    }
    return vec4f(sqrt(things[in.thing].albedo.rgb * light), 1);
}`;

// ---- Matrices, column by column.

/// A box of that size, turned about the vertical.
function box([x, y, z], [w, h, d], turn = 0) {
    const c = Math.cos(turn), s = Math.sin(turn);
    return [w * c, 0, -w * s, 0, 0, h, 0, 0, d * s, 0, d * c, 0, x, y, z, 1];
}

function lookAt(eye, target) {
    const minus = (a, b) => a.map((v, i) => v - b[i]);
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const unit = a => a.map(v => v / Math.hypot(...a));
    const z = unit(minus(eye, target)), x = unit(cross([0, 1, 0], z)), y = cross(z, x);
    return [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1];
}

/// Reversed depth (1 at the near plane), no far plane. As wide as it is high, at least.
function perspective(fov, aspect, near) {
    const f = Math.min(1, aspect) / Math.tan(fov / 2);
    return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, 0, -1, 0, 0, near, 0];
}

// ---- The scene: one mesh, many poses.

const positions = new Float32Array([0, 1, 2, 3, 4, 5, 6, 7].flatMap(i => [i & 1, i >> 1 & 1, i >> 2].map(bit => bit - 0.5)));
const indices = new Uint32Array([0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6]);
const things = [
    {pose: box([0, -0.1, 0], [30, 0.2, 30]), albedo: [0.8, 0.8, 0.78]},
    {pose: box([-0.6, 1.2, -0.4], [0.5, 2.4, 0.5], 0.3), albedo: [0.75, 0.30, 0.22]},
    {pose: box([1.9, 0.5, 0.5], [1, 1, 1], 0.6), albedo: [0.25, 0.45, 0.70]},
    {pose: box([-2.3, 0.35, 1.1], [0.7, 0.7, 1.6], -0.5), albedo: [0.35, 0.60, 0.35]},
    {pose: box([0.7, 0.25, 2.1], [0.5, 0.5, 0.5], 0.9), albedo: [0.80, 0.65, 0.25]},
    {pose: box([0, 0, 0], [1, 0.15, 1]), albedo: [0.7, 0.7, 0.7]},  // the one that turns
];

async function main() {
    const canvas = document.querySelector('canvas');
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) throw new Error('This browser has no WebGPU.');
    const device = await adapter.requestDevice({requiredFeatures: featuresOf(adapter)});  // guest: features
    const format = navigator.gpu.getPreferredCanvasFormat();
    const context = canvas.getContext('webgpu');
    context.configure({device, format});

    // ---- The page's own renderer.
    const buffer = (data, usage) => {
        const made = device.createBuffer({size: data.byteLength, usage: usage | GPUBufferUsage.COPY_DST});
        device.queue.writeBuffer(made, 0, data);
        return made;
    };
    const vertexBuffer = buffer(positions, GPUBufferUsage.VERTEX);
    const indexBuffer = buffer(indices, GPUBufferUsage.INDEX);
    const thingData = new Float32Array(things.length * 36);
    const thingBuffer = buffer(thingData, GPUBufferUsage.STORAGE);
    const lightData = new Float32Array(8);
    const lightBuffer = buffer(lightData, GPUBufferUsage.UNIFORM);

    const {VERTEX, FRAGMENT} = GPUShaderStage;
    const sceneLayout = device.createBindGroupLayout({entries: [
        {binding: 0, visibility: VERTEX | FRAGMENT, buffer: {type: 'read-only-storage'}},
        {binding: 1, visibility: FRAGMENT, buffer: {}},
    ]});
    const maskLayout = device.createBindGroupLayout({entries: [
        {binding: 0, visibility: FRAGMENT, texture: {sampleType: 'uint'}},
    ]});
    const sceneGroup = device.createBindGroup({layout: sceneLayout, entries: [
        {binding: 0, resource: {buffer: thingBuffer}}, {binding: 1, resource: {buffer: lightBuffer}},
    ]});
    const module = device.createShaderModule({code: shader});
    const pipeline = (layouts, fragment, depth) => device.createRenderPipeline({
        layout: device.createPipelineLayout({bindGroupLayouts: layouts}),
        vertex: {module, buffers: [{arrayStride: 12, attributes: [{shaderLocation: 0, offset: 0, format: 'float32x3'}]}]},
        primitive: {cullMode: 'back'},
        depthStencil: {format: 'depth32float', ...depth},
        fragment,
    });
    const depthPipeline = pipeline([sceneLayout], undefined, {depthWriteEnabled: true, depthCompare: 'greater'});
    const shadePipeline = pipeline([sceneLayout, maskLayout], {module, targets: [{format}]},
                                   {depthWriteEnabled: false, depthCompare: 'equal'});
    const draw = pass => {
        pass.setBindGroup(0, sceneGroup);
        pass.setVertexBuffer(0, vertexBuffer);
        pass.setIndexBuffer(indexBuffer, 'uint32');
        for (let i = 0; i < things.length; ++i) pass.drawIndexed(indices.length, 1, 0, 0, i);
    };

    // ---- guest: meshes, casters and lights, once. Depth has the very bits of gnomon's, so nothing needs a bias.
    const shadows = await createShadows(device, {capBias: null});
    const mesh = shadows.addMesh({positions, indices});
    const casters = things.map(({pose}) => shadows.addCaster(mesh, {transform: pose}));
    const toSun = [0.48, 0.6, 0.64];
    const lamp = shadows.addLight({type: 'point', position: [0, 3, 0]});                          // bit 0
    shadows.addLight({type: 'directional', direction: toSun.map(v => -v)});                       // bit 1
    shadows.lost.then(sentence => { document.querySelector('p').textContent = sentence; });

    let depth = null;
    let frames = 0;
    const frame = milliseconds => {
        const seconds = milliseconds / 1000;
        const width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
        const height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
        if (depth?.width !== width || depth?.height !== height) {
            canvas.width = width;
            canvas.height = height;
            depth?.destroy();
            depth = device.createTexture({
                label: 'depth', size: [width, height], format: 'depth32float',
                usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING,  // guest: it is read
            });
        }

        // What moves.
        things.at(-1).pose = box([0.2, 1.9, 1.2], [1.1, 0.15, 1.1], seconds);
        casters.at(-1).setTransform(things.at(-1).pose);  // guest
        const at = [2.2 * Math.cos(0.7 * seconds + 1), 3.2, 2.2 * Math.sin(0.7 * seconds + 1)];
        lamp.set({position: at});  // guest
        lightData.set(at);
        lightData.set(toSun, 4);
        device.queue.writeBuffer(lightBuffer, 0, lightData);

        const view = lookAt([4.2, 4.4, 6.2], [0, 0.6, 0.3]);
        const projection = perspective(0.8, width / height, 0.1);
        things.forEach(({pose, albedo}, i) => {
            thingData.set(clipFromLocal(projection, view, pose), 36 * i);  // guest: rounded once, as shadow volumes are
            thingData.set(pose, 36 * i + 16);
            thingData.set(albedo, 36 * i + 32);
        });
        device.queue.writeBuffer(thingBuffer, 0, thingData);

        // Depth, shadows, picture: one submission.
        const encoder = device.createCommandEncoder();
        const depthPass = encoder.beginRenderPass({colorAttachments: [], depthStencilAttachment: {
            view: depth.createView(), depthLoadOp: 'clear', depthStoreOp: 'store', depthClearValue: 0}});
        depthPass.setPipeline(depthPipeline);
        draw(depthPass);
        depthPass.end();

        const {mask} = shadows.render({encoder, depth, view, projection, reversed: true});  // guest

        const shadePass = encoder.beginRenderPass({
            colorAttachments: [{view: context.getCurrentTexture().createView(), loadOp: 'clear', storeOp: 'store',
                                clearValue: [0.08, 0.09, 0.11, 1]}],
            depthStencilAttachment: {view: depth.createView(), depthReadOnly: true},
        });
        shadePass.setPipeline(shadePipeline);
        shadePass.setBindGroup(1, device.createBindGroup(
            {layout: maskLayout, entries: [{binding: 0, resource: mask.createView()}]}));
        draw(shadePass);
        shadePass.end();
        device.queue.submit([encoder.finish()]);

        document.body.dataset.frames = ++frames;
        requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
}

main().catch(error => {
    document.querySelector('p').textContent = error.message;
    document.body.dataset.failed = error.message;
});
