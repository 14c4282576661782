// Quads on every edge, with one uploaded bit a face.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"
#include "quads.glsl"

// 32 faces a texel.
bool casts(uint face) {
    return (texelFetch(facing, texel(face >> 5), 0).x >> (face & 31u) & 1u) != 0u;
}

void main() { gl_Position = quad_position(); }
