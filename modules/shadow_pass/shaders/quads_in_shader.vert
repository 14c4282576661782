// Quads on every edge; which faces cast is decided here, by a dot product in single precision.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "position.glsl"
#include "quads.glsl"

// A plane a texel, bits of floats. As gnomon::shadows::face_bits_in_single_precision() has it.
bool casts(uint face) {
    vec4 plane = uintBitsToFloat(texelFetch(facing, texel(face), 0));
    precise float side = plane.x * light.x + plane.y * light.y + plane.z * light.z + plane.w * light.w;
    return ranges.w != 0u ? side < 0.0 : side > 0.0;
}

void main() { gl_Position = quad_position(); }
