#version 450
layout(location = 0) in vec4 position;
layout(location = 0) out vec4 v_color;
layout(binding = 0) uniform VertexBlock { vec4 block_color; };

void main() {
    gl_Position = position;
    v_color = block_color;
}
