#version 450
layout(binding = 1) uniform usampler2D source;
layout(location = 0) out uint out_value;

void main() { out_value = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r; }
