// A host that uses gnomon's position function.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"
#include "scene.glsl"

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    gl_Position = clip_position(clip_from_local, vec4(position, 1.0));
    float distance = -(view_from_world * (world_from_local * vec4(position, 1.0))).z;
    in_front = vec2(distance - depth_range.x, depth_range.y - distance);
}
