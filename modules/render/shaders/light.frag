// One light's share, added where the stencil count is zero. GGX with Smith's shadowing and Schlick's Fresnel: B. Walter
// et al., "Microfacet Models for Refraction through Rough Surfaces" (2007).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

layout(set = 1, binding = 0) uniform Light {
    vec4 light_view;      // xyz; w 1: a point, 0: direction towards the light
    vec4 color;           // rgb radiance scale, exposure included; w > 0: perspective
    vec4 spot_axis;       // xyz the way the spot looks, w cosine of the outer cone (-2: no spot)
    vec4 spot_range;      // x cosine of the inner cone, y range in metres (0: none), z 1: light that grazes fades
    vec4 depth_range;     // xy
};

layout(location = 0) out vec4 radiance;

const float pi = 3.14159265;

float attenuation(vec3 to_light, float distance2) {
    float falloff = 1.0 / max(distance2, 1e-12);
    if (spot_range.y > 0.0) {
        float x = distance2 / (spot_range.y * spot_range.y);
        falloff *= clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (spot_axis.w > -1.5) {
        float c = dot(-to_light, spot_axis.xyz);
        float t = clamp((c - spot_axis.w) / max(spot_range.x - spot_axis.w, 1e-4), 0.0, 1.0);
        falloff *= t * t;
    }
    return falloff;
}

void main() {
    Surface s = surface_here(color.w, depth_range.xy);
    vec3 to_light = light_view.xyz - light_view.w * position_view;
    float distance2 = dot(to_light, to_light);
    to_light = normalize(to_light);
    vec3 incoming = color.rgb * (light_view.w > 0.0 ? attenuation(to_light, distance2) : 1.0);

    // Light that grazes the triangle itself fades out where the mask has triangles averted from the light in shadow:
    // their edges would show as saw-teeth.
    if (spot_range.z > 0.0) incoming *= smoothstep(0.0, 0.12, dot(s.geometric_normal, to_light));
    float nl = max(dot(s.normal, to_light), 0.0);
    float nv = max(dot(s.normal, s.to_viewer), 1e-3);
    vec3 h = normalize(to_light + s.to_viewer);
    float nh = max(dot(s.normal, h), 0.0);
    float vh = max(dot(s.to_viewer, h), 0.0);

    float a = s.roughness * s.roughness;
    float d0 = nh * nh * (a * a - 1.0) + 1.0;
    float distribution = a * a / (pi * d0 * d0);
    float visibility = 0.5 / max(mix(2.0 * nl * nv, nl + nv, a), 1e-4);
    vec3 f0 = mix(vec3(0.04), s.base_color, s.metallic);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
    vec3 diffuse = s.base_color * (1.0 - s.metallic) * (1.0 - fresnel) / pi;
    radiance = vec4((diffuse + distribution * visibility * fresnel) * incoming * nl, 1.0);
}
