@group(0) @binding(1) var source: texture_2d<u32>;

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) v_color: vec4f,
}

// One triangle over the whole screen, coloured by the bits of a texel.
@vertex
fn main(@builtin(vertex_index) index: u32) -> Vertex {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return Vertex(vec4f(corner * 4.0 - 1.0, 0.0, 1.0), bitcast<vec4f>(textureLoad(source, vec2i(1, 0), 0)));
}
