// Depth, and what arrives without any light: a sky above, a bounce from below, emission.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

layout(set = 1, binding = 0) uniform Ambient {
    vec4 sky;       // rgb, radiance
    vec4 ground;    // rgb
    vec4 up_view;   // xyz the world's up, w > 0: perspective
    vec4 depth_range;  // xy
};

layout(location = 0) out vec4 radiance;

vec3 environment(vec3 direction) {
    return mix(ground.rgb, sky.rgb, dot(direction, up_view.xyz) * 0.5 + 0.5);
}

void main() {
    Surface s = surface_here(up_view.w, depth_range.xy);
    vec3 diffuse = s.base_color * (1.0 - s.metallic) * environment(s.normal);
    vec3 specular = mix(vec3(0.04), s.base_color, s.metallic) * environment(reflect(-s.to_viewer, s.normal));
    radiance = vec4(diffuse + specular + emissive.rgb, 1.0);
}
