// As forward_multisampled.frag says.
#include "forward.wgsl"

@group(3) @binding(5) var light_mask: texture_multisampled_2d<f32>;
@group(3) @binding(6) var fragment_depth: texture_multisampled_2d<f32>;

fn share_of(pixel: vec2i, mine: f32) -> vec4f {
    let theirs = vec4f(textureLoad(fragment_depth, pixel, 0).r, textureLoad(fragment_depth, pixel, 1).r,
                       textureLoad(fragment_depth, pixel, 2).r, textureLoad(fragment_depth, pixel, 3).r);
    let own = select(vec4f(0.0), vec4f(1.0), abs(theirs - mine) <= vec4f(1e-6 * abs(mine)));
    let count = dot(own, vec4f(1.0));
    if (count > 0.0) { return own / count; }
    return vec4f(0.25);
}

var<private> shares: vec4f;
var<private> masks: vec4u;

fn look_up_light(at: vec4f) -> u32 {
    let pixel = vec2i(at.xy);
    shares = share_of(pixel, at.z);
    masks = vec4u(vec4f(textureLoad(light_mask, pixel, 0).r, textureLoad(light_mask, pixel, 1).r,
                        textureLoad(light_mask, pixel, 2).r, textureLoad(light_mask, pixel, 3).r) * 255.0 + 0.5);
    return ~(masks.x & masks.y & masks.z & masks.w);
}

fn arriving(light: u32) -> f32 { return dot(shares, vec4f(1u - ((masks >> vec4u(light)) & vec4u(1u)))); }
