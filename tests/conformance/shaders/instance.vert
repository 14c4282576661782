#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 offset;  // of the instance
layout(location = 2) in vec4 tint;    // of the instance, from bytes
layout(location = 3) in uint tag;     // of the instance
layout(location = 0) out vec4 v_color;

void main() {
    gl_Position = position + offset;
    v_color = vec4(tint.r, float(tag) / 255.0, float(gl_InstanceIndex) / 255.0, 1.0);
}
