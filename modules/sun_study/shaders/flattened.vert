// A vertex, flattened onto the plan by a matrix that is sheared along the sun's rays.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"

layout(set = 0, binding = 0) uniform Sun { mat4 clip_from_plan; };
layout(location = 0) in vec3 position;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() { gl_Position = clip_position(clip_from_plan, vec4(position, 1.0)); }
