#version 450
layout(binding = 0) uniform FetchBlock { ivec4 sample_index; };
layout(binding = 1) uniform usampler2DMS source;
layout(location = 0) out uint out_value;

void main() { out_value = texelFetch(source, ivec2(gl_FragCoord.xy), sample_index.x).r; }
