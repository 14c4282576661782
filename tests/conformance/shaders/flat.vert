#version 450
layout(location = 0) in vec4 position;  // already in clip space
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 v_color;

void main() {
    gl_Position = position;
    gl_PointSize = 1.0;  // Vulkan wants it written where points are drawn
    v_color = color;
}
