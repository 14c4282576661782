// As tone_map.frag says.
@group(0) @binding(0) var radiance: texture_2d<f32>;

@fragment
fn main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    var x = textureLoad(radiance, vec2i(pixel.xy), 0).rgb;
    x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), vec3f(0.0), vec3f(1.0));
    let low = x * 12.92;
    let high = 1.055 * pow(x, vec3f(1.0 / 2.4)) - 0.055;
    return vec4f(select(high, low, x <= vec3f(0.0031308)), 1.0);
}
