struct VertexBlock {
    block_color: vec4f,
}
@group(0) @binding(0) var<uniform> block: VertexBlock;

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) v_color: vec4f,
}

@vertex
fn main(@location(0) position: vec4f) -> Vertex { return Vertex(position, block.block_color); }
