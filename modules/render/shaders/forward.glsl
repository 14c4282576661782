// A surface with all lights of a round at once, each where the light mask lets it arrive. GGX with Smith's shadowing and
// Schlick's Fresnel: B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces" (2007). Without a
// light: a sky above, a bounce from below, emission.
//
// No loop and no branch hangs on uniforms alone: lavapipe of Mesa 22.3 would compile the shader anew for every draw with
// their values put in, and keep it until the pipeline is gone.
#include "surface.glsl"
#include "frame.glsl"

layout(location = 0) out vec4 radiance;

// Which lights of the round arrive, a bit each (those beyond its lights mean nothing), and how much of each. The shader
// that includes this defines them.
uint look_up_light();
float arriving(uint light);

const float pi = 3.14159265;

struct Surface {
    vec3 position;          // view space
    vec3 base_color;
    float metallic;
    float roughness;
    vec3 normal;            // smooth, towards the viewer
    vec3 geometric_normal;  // of the triangle, towards the viewer
    vec3 to_viewer;
};

// An orthographic camera looks along -Z everywhere: up_view.w is 0 then, else 1.
Surface surface_here() {
    Surface s;
    s.base_color = color_here(depth_range.xy).rgb;
    s.position = position_view;
    s.metallic = parameters.x;
    s.roughness = clamp(parameters.y, 0.06, 1.0);
    s.to_viewer = normalize(mix(vec3(0.0, 0.0, 1.0), -s.position, up_view.w));
    vec3 ng = cross(dFdx(s.position), dFdy(s.position));
    ng = dot(ng, ng) > 0.0 ? normalize(ng) : s.to_viewer;
    s.geometric_normal = dot(ng, s.to_viewer) < 0.0 ? -ng : ng;
    vec3 n = normal_view;
    n = dot(n, n) > 0.0 ? normalize(n) : s.geometric_normal;
    s.normal = dot(n, s.geometric_normal) < 0.0 ? -n : n;
    return s;
}

vec3 environment(vec3 direction) {
    return mix(ground.rgb, sky.rgb, dot(direction, up_view.xyz) * 0.5 + 0.5);
}

vec3 unlit(Surface s) {
    vec3 diffuse = s.base_color * (1.0 - s.metallic) * environment(s.normal);
    vec3 specular = mix(vec3(0.04), s.base_color, s.metallic) * environment(reflect(-s.to_viewer, s.normal));
    return diffuse + specular + emissive.rgb;
}

float attenuation(Light light, vec3 to_light, float distance2) {
    float falloff = 1.0 / max(distance2, 1e-12);
    if (light.spot_range.y > 0.0) {
        float x = distance2 / (light.spot_range.y * light.spot_range.y);
        falloff *= clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (light.spot_axis.w > -1.5) {
        float c = dot(-to_light, light.spot_axis.xyz);
        float t = clamp((c - light.spot_axis.w) / max(light.spot_range.x - light.spot_axis.w, 1e-4), 0.0, 1.0);
        falloff *= t * t;
    }
    return falloff;
}

vec3 lit(Surface s, Light light) {
    vec3 to_light = light.light_view.xyz - light.light_view.w * s.position;
    float distance2 = dot(to_light, to_light);
    to_light = normalize(to_light);
    vec3 incoming = light.color.rgb * (light.light_view.w > 0.0 ? attenuation(light, to_light, distance2) : 1.0);

    // Light that grazes the triangle itself fades out where the mask has triangles averted from the light in shadow:
    // their edges would show as saw-teeth.
    if (light.spot_range.z > 0.0) incoming *= smoothstep(0.0, 0.12, dot(s.geometric_normal, to_light));
    float nl = max(dot(s.normal, to_light), 0.0);
    float nv = max(dot(s.normal, s.to_viewer), 1e-3);
    vec3 h = normalize(to_light + s.to_viewer);
    float nh = max(dot(s.normal, h), 0.0);
    // The lengths are rounded: beyond 1 the power below would be of a negative number, which is no number.
    float vh = clamp(dot(s.to_viewer, h), 0.0, 1.0);

    float a = s.roughness * s.roughness;
    float d0 = nh * nh * (a * a - 1.0) + 1.0;
    float distribution = a * a / (pi * d0 * d0);
    float visibility = 0.5 / max(mix(2.0 * nl * nv, nl + nv, a), 1e-4);
    vec3 f0 = mix(vec3(0.04), s.base_color, s.metallic);
    vec3 fresnel = f0 + (1.0 - f0) * pow(max(1.0 - vh, 0.0), 5.0);  // rounding may leave less than 0
    vec3 diffuse = s.base_color * (1.0 - s.metallic) * (1.0 - fresnel) / pi;
    return (diffuse + distribution * visibility * fresnel) * incoming * nl;
}

void main() {
    Surface s = surface_here();
    vec3 sum = unlit(s) * float(lit_by.y);
    // As often as lights arrive here.
    uint rest = look_up_light() & ((1u << lit_by.x) - 1u);
    for (; rest != 0u; rest &= rest - 1u) {
        uint i = uint(findLSB(rest));
        float share = arriving(i);
        if (share > 0.0) sum += share * lit(s, lights[i]);
    }
    radiance = vec4(sum, 1.0);
}
