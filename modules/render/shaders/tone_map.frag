// Radiance to display: a filmic curve (K. Narkowicz's fit of the ACES reference, 2016), then the sRGB transfer function.
#version 450
layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(location = 0) out vec4 display;

void main() {
    vec3 x = texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb;
    x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    vec3 low = x * 12.92;
    vec3 high = 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055;
    display = vec4(mix(high, low, lessThanEqual(x, vec3(0.0031308))), 1.0);
}
