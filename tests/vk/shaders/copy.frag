#version 450
layout(binding = 1) uniform sampler2D source;
layout(location = 0) out vec4 out_color;

void main() { out_color = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
