// SPDX-License-Identifier: MIT
//
// Depth of a host's that has no stencil of its own to lend: copied, sample by sample, into a texture that has one. WebGPU
// copies no depth from one format to another, so a pass reads it and writes it as fragments' depth. 32-bit floats keep
// their bits.

/// Of what volumes are counted in.
export const countedFormat = 'depth32float-stencil8';
/// Of depth that can be taken. Sixteen bits are too few: a step of depth would be wider than what near caps are moved by.
export const takenFormats = ['depth32float-stencil8', 'depth32float', 'depth24plus', 'depth24plus-stencil8'];

const code = multisampled => `
@group(0) @binding(0) var depth: texture_depth_${multisampled ? 'multisampled_2d' : '2d'};

@vertex
fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn copy(@builtin(position) at: vec4f${multisampled ? ', @builtin(sample_index) sample: u32' : ''}) -> @builtin(frag_depth) f32 {
    return textureLoad(depth, vec2u(at.xy), ${multisampled ? 'sample' : '0'});
}`;

/// Copies into one texture of its own.
export class DepthCopy {
    constructor(device, {width, height, sampleCount}) {
        this.device = device;
        this.texture = device.createTexture({
            label: 'gnomon depth', size: [width, height], format: countedFormat, sampleCount,
            usage: GPUTextureUsage.RENDER_ATTACHMENT,
        });
        const module = device.createShaderModule({label: 'gnomon depth copy', code: code(sampleCount > 1)});
        this.pipeline = device.createRenderPipeline({
            label: 'gnomon depth copy', layout: 'auto',
            vertex: {module, entryPoint: 'corner'},
            fragment: {module, entryPoint: 'copy', targets: []},
            depthStencil: {format: countedFormat, depthWriteEnabled: true, depthCompare: 'always'},
            multisample: {count: sampleCount},
        });
        this.view = this.texture.createView();
        this.source = null;  // what the bind group reads
    }

    record(encoder, depth) {
        if (this.source !== depth) {
            const resource = depth.createView({dimension: '2d', aspect: 'depth-only', mipLevelCount: 1, arrayLayerCount: 1});
            this.bindGroup = this.device.createBindGroup(
                {label: 'gnomon depth copy', layout: this.pipeline.getBindGroupLayout(0), entries: [{binding: 0, resource}]});
            this.source = depth;
        }
        const pass = encoder.beginRenderPass({
            label: 'gnomon depth copy', colorAttachments: [],
            depthStencilAttachment: {
                view: this.view, depthLoadOp: 'clear', depthStoreOp: 'store', depthClearValue: 0,
                stencilLoadOp: 'clear', stencilStoreOp: 'discard',
            },
        });
        pass.setPipeline(this.pipeline);
        pass.setBindGroup(0, this.bindGroup);
        pass.draw(3);
        pass.end();
    }

    destroy() { this.texture.destroy(); }
}
