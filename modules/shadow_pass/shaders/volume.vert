// A vertex of a shadow volume. Every welded vertex of the mesh is there twice: even indices are the near vertex, where
// the mesh has it; odd ones are the far vertex, pushed away from the light here.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "instance.glsl"
#include "position.glsl"

layout(location = 0) in vec3 position;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    if ((gl_VertexIndex & 1) == 0) {
        gl_Position = clip_position(clip_from_local, vec4(position, 1.0));
    } else {
        precise vec3 far = position * far_scale + far_offset.xyz;
        gl_Position = clip_position(clip_from_far, vec4(far, far_offset.w));
    }
}
