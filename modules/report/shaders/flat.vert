// A caster flattened onto a plane; how high above the plane it is goes along.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"
#include "draw.glsl"

layout(location = 0) in vec3 position;
layout(location = 0) out float height_m;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    gl_Position = clip_position(clip_from_local, vec4(position, 1.0));
    height_m = dot(light_from_local[0], vec4(position, 1.0));
}
