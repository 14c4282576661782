// The scene's positions alone: for depth, and for its triangles as lines.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"

layout(set = 0, binding = 1) uniform Draw {
    mat4 clip_from_local;
};

layout(location = 0) in vec3 position;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    gl_Position = clip_position(clip_from_local, vec4(position, 1.0));
}
