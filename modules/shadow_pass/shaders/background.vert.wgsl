// As background.vert says.
@vertex
fn main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let v = index % 3u;
    let corner = vec2f(f32((v << 1u) & 2u), f32(v & 2u));
    let depth = select(select(-1.0, 1.0, index < 6u), 0.0, index < 3u);
    return vec4f(corner * 2.0 - 1.0, depth, 1.0);
}
