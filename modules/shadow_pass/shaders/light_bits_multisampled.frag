// The same for each sample.
#version 450
layout(set = 0, binding = 0) uniform sampler2DMS bytes;
layout(location = 0) out uint bits;

void main() {
    uvec4 b = uvec4(texelFetch(bytes, ivec2(gl_FragCoord.xy), gl_SampleID) * 255.0 + 0.5);
    bits = b.r | b.g << 8 | b.b << 16 | b.a << 24;
}
