struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) v_color: vec4f,
}

@vertex
fn main(@builtin(instance_index) instance: u32, @location(0) position: vec4f, @location(1) offset: vec4f,
        @location(2) tint: vec4f, @location(3) tag: u32) -> Vertex {
    return Vertex(position + offset, vec4f(tint.r, f32(tag) / 255.0, f32(instance) / 255.0, 1.0));
}
