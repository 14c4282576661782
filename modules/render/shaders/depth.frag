// Depth alone, of what may have holes.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"
#include "frame.glsl"

void main() { color_here(depth_range.xy); }
