// Forward shading, one sample a pixel.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "forward.glsl"

layout(set = 3, binding = 5) uniform sampler2D light_mask;

uint mask;

uint look_up_light() {
    mask = uint(texelFetch(light_mask, ivec2(gl_FragCoord.xy), 0).r * 255.0 + 0.5);
    return ~mask;
}

float arriving(uint light) { return float(1u - (mask >> light & 1u)); }
