@group(0) @binding(1) var depth: texture_depth_2d;
@group(0) @binding(2) var stencil: texture_2d<u32>;

// Both aspects of one texture at once.
@fragment
fn main(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    return vec4f(textureLoad(depth, pixel, 0), f32(textureLoad(stencil, pixel, 0).r), 0.0, 1.0);
}
