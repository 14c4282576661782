@group(0) @binding(1) var source: texture_2d<u32>;

@fragment
fn main(@builtin(position) at: vec4f) -> @location(0) u32 { return textureLoad(source, vec2i(at.xy), 0).r; }
