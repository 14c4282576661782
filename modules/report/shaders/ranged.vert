// Positions, where nothing is clipped by depth: fragments are told the range that is seen.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"
#include "draw.glsl"

layout(location = 0) in vec3 position;
layout(location = 0) out vec2 range_m;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    gl_Position = clip_position(clip_from_local, vec4(position, 1.0));
    range_m = light_from_local[0].xy;
}
