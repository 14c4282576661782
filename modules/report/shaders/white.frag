#version 450
layout(location = 0) out vec4 shadow;
void main() { shadow = vec4(1.0); }
