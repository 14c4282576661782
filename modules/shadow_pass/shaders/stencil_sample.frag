// Copies one sample of a multisampled stencil buffer into an integer target.
#version 450
layout(set = 0, binding = 0) uniform Choice {
    ivec4 sample_index;  // x alone
};
layout(set = 0, binding = 1) uniform usampler2DMS stencil;
layout(location = 0) out uint count;

void main() {
    count = texelFetch(stencil, ivec2(gl_FragCoord.xy), sample_index.x).r;
}
