struct FetchBlock {
    sample_index: vec4i,
}
@group(0) @binding(0) var<uniform> block: FetchBlock;
@group(0) @binding(1) var source: texture_multisampled_2d<u32>;

@fragment
fn main(@builtin(position) at: vec4f) -> @location(0) u32 {
    return textureLoad(source, vec2i(at.xy), block.sample_index.x).r;
}
