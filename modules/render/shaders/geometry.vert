// The scene's geometry, for the passes that shade it, and for the depth of what has holes. Shading happens in
// view space, so that it is as exact a million metres out as at the origin.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"

layout(set = 0, binding = 1) uniform Draw {
    mat4 clip_from_local;
    mat4 view_from_local;
    mat4 normal_matrix;  // upper 3x3: cofactors, so that a flat scale still has normals
};

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;

layout(location = 0) out vec3 position_view;
layout(location = 1) out vec3 normal_view;
layout(location = 2) out vec2 uv;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    gl_Position = clip_position(clip_from_local, vec4(position, 1.0));
    position_view = (view_from_local * vec4(position, 1.0)).xyz;
    normal_view = mat3(normal_matrix) * normal;
    uv = texcoord;
}
