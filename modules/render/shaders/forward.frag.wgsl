// Forward shading, one sample a pixel.
#include "forward.wgsl"

@group(3) @binding(5) var light_mask: texture_2d<f32>;

var<private> mask: u32;

fn look_up_light(pixel: vec4f) -> u32 {
    mask = u32(textureLoad(light_mask, vec2i(pixel.xy), 0).r * 255.0 + 0.5);
    return ~mask;
}

fn arriving(light: u32) -> f32 { return f32(1u - ((mask >> light) & 1u)); }
