// As forward.glsl says; the shader that includes this defines look_up_light() and arriving().
#include "surface.wgsl"
#include "frame.wgsl"

const pi = 3.14159265;

struct Surface {
    position: vec3f,  // view space
    base_color: vec3f,
    metallic: f32,
    roughness: f32,
    normal: vec3f,            // smooth, towards the viewer
    geometric_normal: vec3f,  // of the triangle, towards the viewer
    to_viewer: vec3f,
}

// An orthographic camera looks along -Z everywhere: up_view.w is 0 then, else 1.
fn surface_here(at: Fragment) -> Surface {
    var s: Surface;
    s.base_color = color_here(at, frame.depth_range.xy).rgb;
    s.position = at.position_view;
    s.metallic = material.parameters.x;
    s.roughness = clamp(material.parameters.y, 0.06, 1.0);
    s.to_viewer = normalize(mix(vec3f(0.0, 0.0, 1.0), -s.position, frame.up_view.w));
    var ng = cross(dpdx(s.position), dpdy(s.position));
    ng = select(s.to_viewer, normalize(ng), dot(ng, ng) > 0.0);
    s.geometric_normal = select(ng, -ng, dot(ng, s.to_viewer) < 0.0);
    var n = at.normal_view;
    n = select(s.geometric_normal, normalize(n), dot(n, n) > 0.0);
    s.normal = select(n, -n, dot(n, s.geometric_normal) < 0.0);
    return s;
}

fn environment(direction: vec3f) -> vec3f {
    return mix(frame.ground.rgb, frame.sky.rgb, dot(direction, frame.up_view.xyz) * 0.5 + 0.5);
}

fn unlit(s: Surface) -> vec3f {
    let diffuse = s.base_color * (1.0 - s.metallic) * environment(s.normal);
    let specular = mix(vec3f(0.04), s.base_color, s.metallic) * environment(reflect(-s.to_viewer, s.normal));
    return diffuse + specular + material.emissive.rgb;
}

fn attenuation(light: Light, to_light: vec3f, distance2: f32) -> f32 {
    var falloff = 1.0 / max(distance2, 1e-12);
    if (light.spot_range.y > 0.0) {
        let x = distance2 / (light.spot_range.y * light.spot_range.y);
        falloff *= clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (light.spot_axis.w > -1.5) {
        let c = dot(-to_light, light.spot_axis.xyz);
        let t = clamp((c - light.spot_axis.w) / max(light.spot_range.x - light.spot_axis.w, 1e-4), 0.0, 1.0);
        falloff *= t * t;
    }
    return falloff;
}

fn lit(s: Surface, light: Light) -> vec3f {
    var to_light = light.light_view.xyz - light.light_view.w * s.position;
    let distance2 = dot(to_light, to_light);
    to_light = normalize(to_light);
    var incoming = light.color.rgb;
    if (light.light_view.w > 0.0) { incoming *= attenuation(light, to_light, distance2); }

    if (light.spot_range.z > 0.0) { incoming *= smoothstep(0.0, 0.12, dot(s.geometric_normal, to_light)); }
    let nl = max(dot(s.normal, to_light), 0.0);
    let nv = max(dot(s.normal, s.to_viewer), 1e-3);
    let h = normalize(to_light + s.to_viewer);
    let nh = max(dot(s.normal, h), 0.0);
    let vh = clamp(dot(s.to_viewer, h), 0.0, 1.0);

    let a = s.roughness * s.roughness;
    let d0 = nh * nh * (a * a - 1.0) + 1.0;
    let distribution = a * a / (pi * d0 * d0);
    let visibility = 0.5 / max(mix(2.0 * nl * nv, nl + nv, a), 1e-4);
    let f0 = mix(vec3f(0.04), s.base_color, s.metallic);
    let fresnel = f0 + (1.0 - f0) * pow(max(1.0 - vh, 0.0), 5.0);
    let diffuse = s.base_color * (1.0 - s.metallic) * (1.0 - fresnel) / pi;
    return (diffuse + distribution * visibility * fresnel) * incoming * nl;
}

@fragment
fn main(at: Fragment) -> @location(0) vec4f {
    let s = surface_here(at);
    var sum = unlit(s) * f32(frame.lit_by.y);
    // As often as lights arrive here.
    for (var rest = look_up_light(at.pixel) & ((1u << frame.lit_by.x) - 1u); rest != 0u; rest &= rest - 1u) {
        let i = firstTrailingBit(rest);
        let share = arriving(i);
        if (share > 0.0) { sum += share * lit(s, frame.lights[i]); }
    }
    return vec4f(sum, 1.0);
}
