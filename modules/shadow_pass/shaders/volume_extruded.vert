// The same for far vertices that the CPU has pushed away already (gnomon::shadows::extrude).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "instance.glsl"
#include "position.glsl"

layout(location = 0) in vec4 position;

out gl_PerVertex {
    invariant vec4 gl_Position;
};

void main() {
    if ((gl_VertexIndex & 1) == 0) {
        gl_Position = clip_position(clip_from_local, vec4(position.xyz, 1.0));
    } else {
        gl_Position = clip_position(clip_from_far, position);
    }
}
