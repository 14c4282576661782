struct SampleBlock {
    uv_lod: vec4f,
}
@group(0) @binding(0) var<uniform> block: SampleBlock;
@group(0) @binding(1) var source: texture_2d<f32>;
@group(0) @binding(101) var source_sampler: sampler;

// The same place for every pixel.
@fragment
fn main() -> @location(0) vec4f { return textureSampleLevel(source, source_sampler, block.uv_lod.xy, block.uv_lod.z); }
