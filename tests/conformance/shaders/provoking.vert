#version 450
layout(location = 0) in vec4 position;
layout(location = 0) flat out vec4 v_color;

void main() {
    gl_Position = position;
    v_color = vec4(float(gl_VertexIndex + 1) / 255.0, 0.0, 0.0, 1.0);
}
