// Positions alone, by the function that shadow volumes use as well.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"
#include "draw.glsl"

layout(location = 0) in vec3 position;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() { gl_Position = clip_position(clip_from_local, vec4(position, 1.0)); }
