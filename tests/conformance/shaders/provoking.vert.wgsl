struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat, first) v_color: vec4f,
}

@vertex
fn main(@builtin(vertex_index) index: u32, @location(0) position: vec4f) -> Vertex {
    return Vertex(position, vec4f(f32(index + 1u) / 255.0, 0.0, 0.0, 1.0));
}
