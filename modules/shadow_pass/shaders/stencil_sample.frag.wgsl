// Copies one sample of a multisampled stencil buffer into an integer target.
struct Choice {
    sample_index: vec4i,  // x alone
}
@group(0) @binding(0) var<uniform> choice: Choice;
@group(0) @binding(1) var stencil: texture_multisampled_2d<u32>;

@fragment
fn main(@builtin(position) pixel: vec4f) -> @location(0) u32 {
    return textureLoad(stencil, vec2i(pixel.xy), choice.sample_index.x).r;
}
