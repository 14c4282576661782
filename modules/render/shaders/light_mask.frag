// Where a light does not arrive (the stencil says so), its bit is added to the mask: the blend constant.
#version 450
layout(location = 0) out vec4 bit;
void main() { bit = vec4(1.0); }
