struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) v_color: vec4f,
}

@vertex
fn main(@location(0) position: vec4f, @location(1) color: vec4f) -> Vertex { return Vertex(position, color); }
