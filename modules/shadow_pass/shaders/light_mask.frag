// Where a light does not arrive (the stencil says so): its bit is added to a mask, as the blend constant, or all of it is
// written.
#version 450
layout(location = 0) out vec4 mask;
void main() { mask = vec4(1.0); }
