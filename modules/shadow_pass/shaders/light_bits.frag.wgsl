// As light_bits.frag says.
@group(0) @binding(0) var bytes: texture_2d<f32>;

@fragment
fn main(@builtin(position) pixel: vec4f) -> @location(0) u32 {
    let b = vec4u(textureLoad(bytes, vec2i(pixel.xy), 0) * 255.0 + 0.5);
    return b.r | (b.g << 8) | (b.b << 16) | (b.a << 24);
}
