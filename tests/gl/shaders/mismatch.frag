#version 450
// Wants an input that no vertex shader here writes, and of another type at location 0.
layout(location = 0) flat in ivec4 v_color;
layout(location = 0) out vec4 out_color;

void main() { out_color = vec4(v_color); }
