#version 450
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform usampler2D stencil;
layout(location = 0) out vec4 out_color;

// Both aspects of one texture at once.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    out_color = vec4(texelFetch(depth, pixel, 0).r, float(texelFetch(stencil, pixel, 0).r), 0.0, 1.0);
}
