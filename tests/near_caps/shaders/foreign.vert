// A host with shaders of its own: three matrices, one after the other, in single precision.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

void main() {
    vec4 position_view = view_from_world * (world_from_local * vec4(position, 1.0));
    gl_Position = clip_from_view * position_view;
    in_front = vec2(-position_view.z - depth_range.x, depth_range.y + position_view.z);
}
