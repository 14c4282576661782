#version 450
layout(location = 0) in vec4 v_color;
layout(location = 0) out uint out_value;

void main() { out_value = uint(v_color.r + 0.5); }
