// A surface that looks itself up in a shadow map.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"
#include "draw.glsl"

layout(location = 0) in vec3 position;
layout(location = 0) out vec4 position_light;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    gl_Position = clip_position(clip_from_local, vec4(position, 1.0));
    position_light = light_from_local * vec4(position, 1.0);
}
