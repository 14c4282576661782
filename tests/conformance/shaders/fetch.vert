#version 450
layout(binding = 1) uniform usampler2D source;
layout(location = 0) out vec4 v_color;

// One triangle over the whole screen, coloured by the bits of a texel.
void main() {
    vec2 corner = vec2(float(gl_VertexIndex & 1), float(gl_VertexIndex >> 1));
    gl_Position = vec4(corner * 4.0 - 1.0, 0.0, 1.0);
    v_color = uintBitsToFloat(texelFetch(source, ivec2(1, 0), 0));
}
