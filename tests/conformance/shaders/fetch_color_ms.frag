#version 450
layout(binding = 0) uniform FetchBlock { ivec4 sample_index; };
layout(binding = 1) uniform sampler2DMS source;
layout(location = 0) out vec4 out_color;

void main() { out_color = texelFetch(source, ivec2(gl_FragCoord.xy), sample_index.x); }
