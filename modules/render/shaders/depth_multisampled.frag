// Depth of what may have holes, and at each sample whose it is (forward_multisampled.frag).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"
#include "frame.glsl"

layout(location = 0) out float fragment_depth;

void main() {
    color_here(depth_range.xy);
    fragment_depth = gl_FragCoord.z;
}
