#version 450
layout(binding = 0) uniform SampleBlock { vec4 uv_lod; };
layout(binding = 1) uniform sampler2D source;
layout(location = 0) out vec4 out_color;

// The same place for every pixel.
void main() { out_color = textureLod(source, uv_lod.xy, uv_lod.z); }
