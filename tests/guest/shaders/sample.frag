// A sample's integer, at the pixel where it is.
#version 450
layout(push_constant) uniform Choice {
    int wanted;
};
layout(set = 0, binding = 0) uniform usampler2DMS source;
layout(location = 0) out uint value;
void main() { value = texelFetch(source, ivec2(gl_FragCoord.xy), wanted).r; }
