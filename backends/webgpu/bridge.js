// SPDX-License-Identifier: MIT
//
// The half of gnomon::webgpu that speaks to the browser. The C++ half hands over plain data: descriptors as WebGPU's own
// dictionaries in JSON, in which objects are numbers, and command lists as 32-bit words (command_words.cpp). This turns
// them into calls of a GPUDevice and keeps the objects that the numbers mean. It knows nothing of shadows, and of
// Emscripten only that memory is an ArrayBuffer (library.js is the link).

// As Kind in internal/bridge.hpp.
const kinds = ['buffer', 'texture', 'sampler', 'shader', 'bindGroupLayout', 'bindGroup', 'renderPipeline', 'querySet'];
// As Outcome in internal/bridge.hpp.
const outcome = {done: 0, unsupported: 1, outOfMemory: 2, deviceLost: 3, internal: 4};
// As gpu::Aspect.
const aspects = ['all', 'depth-only', 'stencil-only'];
const none = 0xffffffff;
const bytesPerRowAlignment = 256;

const wantedFeatures = ['depth32float-stencil8', 'depth-clip-control', 'timestamp-query', 'float32-filterable'];
// More than WebGPU's defaults, where the adapter has it.
const wantedLimits = ['maxBufferSize', 'maxTextureDimension2D'];

/// Whether a C++ call may wait for the device (Bridge.waiting).
export function canWait() {
    return typeof WebAssembly.Suspending === 'function' && typeof WebAssembly.promising === 'function';
}

/// A bridge to a device of its own. `disabledFeatures` are left out although the adapter has them, for tests of
/// fallbacks. Throws an Error of one sentence where the browser has no WebGPU or no adapter.
export async function createBridge({gpu = globalThis.navigator?.gpu, canvas = null, disabledFeatures = []} = {}) {
    if (!gpu) {
        throw new Error(globalThis.isSecureContext === false
            ? 'WebGPU is missing: browsers give it to pages from https: or this machine, and this one is from elsewhere.'
            : 'WebGPU is missing: this browser does not have navigator.gpu.');
    }
    const adapter = await gpu.requestAdapter({powerPreference: 'high-performance'}).catch(() => null);
    if (!adapter) throw new Error('WebGPU is there, but this browser gives no adapter to draw with.');
    const requiredFeatures = wantedFeatures.filter(f => adapter.features.has(f) && !disabledFeatures.includes(f));
    const requiredLimits = Object.fromEntries(wantedLimits.map(name => [name, adapter.limits[name]]));
    const device = await adapter.requestDevice({label: 'gnomon', requiredFeatures, requiredLimits}).catch(error => {
        throw new Error(`This browser gives no WebGPU device: ${error.message.replace(/\.$/, '')}.`);
    });
    return new Bridge(device, {canvas, info: adapter.info, disabledFeatures});
}

/// Why a call is refused, as an outcome and a sentence.
class Refusal extends Error {
    constructor(code, sentence) {
        super(sentence);
        this.code = code;
    }
}

/// The translator for one device. `canvas` is where pictures are shown, if anywhere. It then has the size of the last picture;
/// to stretch it is CSS's business. `adopted`: the device is a host's, who also hears what it complains of; what is drawn goes
/// into `encoder` where the host has put a GPUCommandEncoder of its own there, and is submitted with it.
export class Bridge {
    constructor(device, {canvas = null, info = device.adapterInfo, disabledFeatures = [], adopted = false} = {}) {
        this.device = device;
        this.canvas = canvas;
        this.info = info;
        this.disabledFeatures = disabledFeatures;
        this.lost = null;       // one sentence once the device is lost
        this.waits = 0;         // calls under way that may wait
        this.messages = [];     // what the device complained of, for the message sink
        this.error = '';        // what the last outcome but `done` means
        this.objects = Object.fromEntries(kinds.map(kind => [kind, []]));
        this.nearest = device.createSampler({label: 'nearest'});
        this.encoder = null;
        this.textures = [];     // of the host's, by the number that adopt() answered
        this.scratch = new Float64Array(1);
        this.scratchWords = new Uint32Array(this.scratch.buffer);
        if (!adopted) {
            device.addEventListener('uncapturederror', event => {
                event.preventDefault();
                this.messages.push(event.error.message);
            });
        }
        device.lost.then(({reason, message}) => {
            this.lost = `The WebGPU device is lost (${reason}): ${message || 'the browser does not say why.'}`;
        });
    }

    /// What the device can do, for gpu::Caps.
    describe() {
        const {vendor, architecture, device, description} = this.info ?? {};
        const names = [description, vendor, architecture, device].filter(name => name);
        const limits = {};
        for (const name in this.device.limits) limits[name] = this.device.limits[name];
        const features = [...this.device.features].filter(f => !this.disabledFeatures.includes(f));
        return {adapter: [...new Set(names)].join(' ') || 'unnamed', features, limits};
    }

    /// An exported function of the module as one that may wait for the device; gives a promise.
    waiting(exported) {
        const promising = WebAssembly.promising(exported);
        return async (...args) => {
            ++this.waits;
            try {
                return await promising(...args);
            } finally {
                --this.waits;
            }
        };
    }

    /// Runs `action`, which throws where the browser refuses; gives an outcome.
    attempt(action) {
        if (this.lost) return this.fail('deviceLost', this.lost);
        try {
            action();
            return outcome.done;
        } catch (error) {
            return this.refuse(error);
        }
    }

    /// The same for what waits: a promise of an outcome, or the outcome that says that nothing here can wait.
    attemptWaiting(action) {
        if (this.lost) return this.fail('deviceLost', this.lost);
        if (this.waits === 0) {
            return this.fail('unsupported', 'Reading back waits for the device, which this call cannot do in a browser: ' +
                             (canWait() ? 'call it through Bridge.waiting().'
                                        : 'this browser has no JavaScript Promise Integration.'));
        }
        return action().then(() => outcome.done, error => this.refuse(error));
    }

    fail(code, sentence) {
        this.error = sentence;
        return outcome[code];
    }

    refuse(error) {
        if (this.lost) return this.fail('deviceLost', this.lost);
        if (error instanceof Refusal) return this.fail(error.code, error.message);
        const outOfMemory = error instanceof RangeError || error instanceof GPUOutOfMemoryError;
        return this.fail(outOfMemory ? 'outOfMemory' : 'internal', `The browser refuses: ${error.message}`);
    }

    // Objects

    create(kind, index, text) {
        return this.attempt(() => {
            this.objects[kinds[kind]][index] = this[kinds[kind]](JSON.parse(text));
        });
    }

    /// The browser keeps what submitted work uses.
    destroy(kind, index) {
        const table = this.objects[kinds[kind]];
        const object = table[index];
        table[index] = undefined;
        if (kinds[kind] === 'buffer' || kinds[kind] === 'querySet') object.destroy();
        if (kinds[kind] === 'texture' && !object.imported) object.handle.destroy();
    }

    buffer(desc) { return this.device.createBuffer(desc); }

    texture(desc) {
        if (desc.adopted !== undefined) return this.imported(desc);
        return {handle: this.device.createTexture(desc), format: desc.format, views: new Map(), imported: false};
    }

    /// The number by which a texture of the host's is imported (webgpu::HostTexture).
    adopt(texture) { return this.textures.push(texture) - 1; }

    /// What was imported by the number stays.
    release(number) {
        this.textures[number] = undefined;
        while (this.textures.length > 0 && !this.textures.at(-1)) this.textures.pop();
    }

    imported({label, size: [width, height], format, usage, mipLevelCount, sampleCount, adopted}) {
        const handle = this.textures[adopted];
        const refuse = sentence => { throw new Refusal('unsupported', `[Texture "${label}"] cannot be imported: ${sentence}`); };
        if (!handle) refuse(`the page has adopted no texture by the number ${adopted}.`);
        const words = (w, h, f, levels, samples) => `${w} x ${h} texels of ${f}, mip levels: ${levels}, samples: ${samples}`;
        const said = words(width, height, format, mipLevelCount, sampleCount);
        const is = words(handle.width, handle.height, handle.format, handle.mipLevelCount, handle.sampleCount);
        if (said !== is) refuse(`it has ${is}, not ${said}.`);
        if (handle.dimension !== '2d' || handle.depthOrArrayLayers !== 1) {
            refuse(`it has ${handle.depthOrArrayLayers} layers of dimension ${handle.dimension} instead of one of dimension 2d.`);
        }
        if ((handle.usage & usage) !== usage) {
            refuse(`its usage is ${handle.usage} and lacks some of ${usage} (GPUTextureUsage).`);
        }
        return {handle, format, views: new Map(), imported: true};
    }

    sampler(desc) { return this.device.createSampler(desc); }
    shader(desc) { return this.device.createShaderModule(desc); }
    bindGroupLayout(desc) { return this.device.createBindGroupLayout(desc); }
    querySet(desc) { return this.device.createQuerySet(desc); }

    bindGroup(desc) {
        const entries = desc.entries.map(({binding, buffer, texture, sampler, aspect}) => {
            if (buffer) return {binding, resource: {...buffer, buffer: this.objects.buffer[buffer.buffer]}};
            if (texture !== undefined) return {binding, resource: this.view(texture, aspect)};
            return {binding, resource: sampler === null ? this.nearest : this.objects.sampler[sampler]};
        });
        return this.device.createBindGroup({...desc, layout: this.objects.bindGroupLayout[desc.layout], entries});
    }

    renderPipeline(desc) {
        const {bindGroupLayout, shader} = this.objects;
        desc.layout = this.device.createPipelineLayout(
            {label: desc.label, bindGroupLayouts: desc.layout.map(index => bindGroupLayout[index])});
        desc.vertex.module = shader[desc.vertex.module];
        if (desc.fragment) desc.fragment.module = shader[desc.fragment.module];
        return this.device.createRenderPipeline(desc);
    }

    /// A view of all levels for bindings; of the first level where `aspect` is null, for attachments.
    view(index, aspect) {
        const texture = this.objects.texture[index];
        if (!texture.views.has(aspect)) {
            const desc = aspect === null ? {mipLevelCount: 1} : {aspect};
            texture.views.set(aspect, texture.handle.createView(desc));
        }
        return texture.views.get(aspect);
    }

    // Transfers. `memory` is the module's, at the time of the call; after a wait it may have become another one.

    writeBuffer(index, offset, memory, place, size) {
        return this.attempt(
            () => this.device.queue.writeBuffer(this.objects.buffer[index], offset, memory, place, size));
    }

    writeTexture(index, mipLevel, memory, place, size) {
        return this.attempt(() => {
            const {handle} = this.objects.texture[index];
            const width = Math.max(handle.width >> mipLevel, 1);
            const height = Math.max(handle.height >> mipLevel, 1);
            this.device.queue.writeTexture({texture: handle, mipLevel}, new Uint8Array(memory, place, size),
                                           {bytesPerRow: size / height, rowsPerImage: height}, {width, height});
        });
    }

    readBuffer(index, offset, getMemory, place, size) {
        return this.attemptWaiting(async () => {
            await this.fetch(size, (encoder, staging) => {
                encoder.copyBufferToBuffer(this.objects.buffer[index], offset, staging, 0, size);
            }, bytes => new Uint8Array(getMemory(), place, size).set(bytes.subarray(0, size)));
        });
    }

    readTexture(index, aspect, getMemory, place, size) {
        return this.attemptWaiting(async () => {
            const {handle} = this.objects.texture[index];
            const {width, height} = handle;
            const packed = size / height;
            const bytesPerRow = Math.ceil(packed / bytesPerRowAlignment) * bytesPerRowAlignment;
            await this.fetch(bytesPerRow * height, (encoder, staging) => {
                encoder.copyTextureToBuffer({texture: handle, aspect: aspects[aspect]},
                                            {buffer: staging, bytesPerRow, rowsPerImage: height}, {width, height});
            }, bytes => {
                const out = new Uint8Array(getMemory(), place, size);
                for (let row = 0; row < height; ++row) {
                    out.set(bytes.subarray(row * bytesPerRow, row * bytesPerRow + packed), row * packed);
                }
            });
        });
    }

    readQuerySet(index, getMemory, place) {
        return this.attemptWaiting(async () => {
            const queries = this.objects.querySet[index];
            const size = queries.count * 8;
            const resolved = this.device.createBuffer(
                {size, usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC});
            try {
                await this.fetch(size, (encoder, staging) => {
                    encoder.resolveQuerySet(queries, 0, queries.count, resolved, 0);
                    encoder.copyBufferToBuffer(resolved, 0, staging, 0, size);
                }, bytes => new Uint8Array(getMemory(), place, size).set(bytes));
            } finally {
                resolved.destroy();
            }
        });
    }

    waitIdle() { return this.attemptWaiting(() => this.device.queue.onSubmittedWorkDone()); }

    /// What `copy` puts into a buffer of its own, given to `take`.
    async fetch(size, copy, take) {
        const staging = this.device.createBuffer({size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ});
        try {
            const encoder = this.device.createCommandEncoder();
            copy(encoder, staging);
            this.device.queue.submit([encoder.finish()]);
            await staging.mapAsync(GPUMapMode.READ);
            take(new Uint8Array(staging.getMappedRange()));
        } finally {
            staging.destroy();
        }
    }

    /// Copies a picture onto the canvas, which takes its size.
    present(index) {
        if (!this.canvas) return this.fail('unsupported', 'This WebGPU device was made without a canvas, so nothing can be presented.');
        return this.attempt(() => {
            const {handle, format} = this.objects.texture[index];
            const {width, height} = handle;
            if (!this.context || this.canvas.width !== width || this.canvas.height !== height || this.shown !== format) {
                this.canvas.width = width;
                this.canvas.height = height;
                this.context ??= this.canvas.getContext('webgpu');
                this.context.configure({device: this.device, format: format.replace('-srgb', ''), alphaMode: 'opaque',
                                        usage: GPUTextureUsage.COPY_DST});
                this.shown = format;
            }
            const encoder = this.device.createCommandEncoder();
            encoder.copyTextureToTexture({texture: handle}, {texture: this.context.getCurrentTexture()}, {width, height});
            this.device.queue.submit([encoder.finish()]);
        });
    }

    // Commands

    submit(memory, place, count) {
        return this.attempt(() => {
            const words = new Words(memory, place, count, this);
            const label = words.string();
            if (this.encoder) {
                this.record(this.encoder, words);
                return;
            }
            const encoder = this.device.createCommandEncoder({label});
            this.record(encoder, words);
            this.device.queue.submit([encoder.finish()]);
        });
    }

    record(encoder, words) {
        let pass = null;
        let debug = encoder;
        while (!words.ended()) {
            switch (words.u32()) {  // as the alternatives of gpu::Command
                case 0:
                    pass = encoder.beginRenderPass(this.pass(words));
                    debug = pass;
                    break;
                case 1:
                    pass.end();
                    debug = encoder;
                    break;
                case 2: pass.setPipeline(this.objects.renderPipeline[words.u32()]); break;
                case 3: {
                    const group = words.u32();
                    const bindGroup = this.objects.bindGroup[words.u32()];
                    const offsets = words.u32();
                    pass.setBindGroup(group, bindGroup, words.unsigned, words.skip(offsets), offsets);
                    break;
                }
                case 4: pass.setVertexBuffer(words.u32(), this.objects.buffer[words.u32()], words.u64()); break;
                case 5: pass.setIndexBuffer(this.objects.buffer[words.u32()], words.u32() ? 'uint32' : 'uint16', words.u64()); break;
                case 6: pass.setStencilReference(words.u32()); break;
                case 7: pass.setBlendConstant(words.color()); break;
                case 8: pass.setViewport(words.f32(), words.f32(), words.f32(), words.f32(), words.f32(), words.f32()); break;
                case 9: pass.setScissorRect(words.u32(), words.u32(), words.u32(), words.u32()); break;
                // 10, depth bounds, is a feature that WebGPU does not have.
                case 11: pass.draw(words.u32(), words.u32(), words.u32(), words.u32()); break;
                case 12: pass.drawIndexed(words.u32(), words.u32(), words.u32(), words.i32(), words.u32()); break;
                case 13: pass.beginOcclusionQuery(words.u32()); break;
                case 14: pass.endOcclusionQuery(); break;
                case 15: debug.pushDebugGroup(words.string()); break;
                case 16: debug.popDebugGroup(); break;
                case 17: {
                    const source = this.objects.buffer[words.u32()];
                    const sourceOffset = words.u64();
                    const destination = this.objects.buffer[words.u32()];
                    encoder.copyBufferToBuffer(source, sourceOffset, destination, words.u64(), words.u64());
                    break;
                }
                default: throw new Error(`Word ${words.at - 1} of the command list is no command.`);
            }
        }
    }

    pass(words) {
        const desc = {label: words.string(), colorAttachments: []};
        for (let left = words.u32(); left > 0; --left) {
            desc.colorAttachments.push({
                view: this.view(words.u32(), null),
                resolveTarget: words.optional(index => this.view(index, null)),
                loadOp: words.loadOp(),
                storeOp: words.storeOp(),
                clearValue: words.color(),
            });
        }
        desc.depthStencilAttachment = words.optional(index => {
            const attachment = {view: this.view(index, null)};
            const {format} = this.objects.texture[index];
            for (const part of ['depth', 'stencil']) {
                const loadOp = words.loadOp();
                const storeOp = words.storeOp();
                const readOnly = words.u32() !== 0;
                const clearValue = part === 'depth' ? words.f32() : words.u32();
                if (!format.includes(part)) continue;
                attachment[`${part}ReadOnly`] = readOnly;
                attachment[`${part}ClearValue`] = clearValue;
                if (readOnly) continue;
                attachment[`${part}LoadOp`] = loadOp;
                attachment[`${part}StoreOp`] = storeOp;
            }
            return attachment;
        });
        desc.occlusionQuerySet = words.optional(index => this.objects.querySet[index]);
        desc.timestampWrites = words.optional(index => ({
            querySet: this.objects.querySet[index],
            beginningOfPassWriteIndex: words.u32(),
            endOfPassWriteIndex: words.u32(),
        }));
        return desc;
    }
}

/// Reads what command_words.cpp wrote.
class Words {
    constructor(memory, place, count, {scratch, scratchWords}) {
        this.unsigned = new Uint32Array(memory, place, count);
        this.signed = new Int32Array(memory, place, count);
        this.floats = new Float32Array(memory, place, count);
        this.scratch = scratch;
        this.scratchWords = scratchWords;
        this.at = 0;
    }

    ended() { return this.at >= this.unsigned.length; }
    u32() { return this.unsigned[this.at++]; }
    i32() { return this.signed[this.at++]; }
    f32() { return this.floats[this.at++]; }
    u64() { return this.u32() + this.u32() * 2 ** 32; }

    f64() {
        this.scratchWords[0] = this.u32();
        this.scratchWords[1] = this.u32();
        return this.scratch[0];
    }

    /// The place of `count` words, which are passed over.
    skip(count) {
        this.at += count;
        return this.at - count;
    }

    string() {
        const length = this.u32();
        const words = this.skip(Math.ceil(length / 4));
        const bytes = new Uint8Array(this.unsigned.buffer, this.unsigned.byteOffset + words * 4, length);
        return new TextDecoder().decode(bytes);
    }

    color() { return {r: this.f64(), g: this.f64(), b: this.f64(), a: this.f64()}; }
    loadOp() { return this.u32() ? 'clear' : 'load'; }
    storeOp() { return this.u32() ? 'discard' : 'store'; }

    /// Undefined where no object is named.
    optional(make) {
        const index = this.u32();
        return index === none ? undefined : make(index);
    }
}
