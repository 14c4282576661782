// The surface under a fragment: material and normals, shared by the ambient and the light pass.

layout(set = 2, binding = 2) uniform Material {
    vec4 base_color;    // linear
    vec4 emissive;      // rgb
    vec4 parameters;    // x metallic, y roughness, z alpha cutoff (negative: opaque), w unused
};
layout(set = 2, binding = 3) uniform sampler2D base_color_texture;

layout(location = 0) in vec3 position_view;
layout(location = 1) in vec3 normal_view;
layout(location = 2) in vec2 uv;

struct Surface {
    vec3 base_color;
    float metallic;
    float roughness;
    vec3 normal;            // smooth, towards the viewer
    vec3 geometric_normal;  // of the triangle, towards the viewer
    vec3 to_viewer;
};

// `perspective` is 0 for an orthographic camera, which looks along -Z everywhere. What lies outside `depth_range`
// (metres in front of the eye) is cut off here where the pipeline does not clip (docs/conventions.md).
Surface surface_here(float perspective, vec2 depth_range) {
    if (-position_view.z < depth_range.x || -position_view.z > depth_range.y) discard;
    Surface s;
    vec4 color = base_color * texture(base_color_texture, uv);
    if (color.a < parameters.z) discard;
    s.base_color = color.rgb;
    s.metallic = parameters.x;
    s.roughness = clamp(parameters.y, 0.06, 1.0);
    s.to_viewer = perspective > 0.0 ? normalize(-position_view) : vec3(0.0, 0.0, 1.0);
    vec3 ng = cross(dFdx(position_view), dFdy(position_view));
    ng = dot(ng, ng) > 0.0 ? normalize(ng) : s.to_viewer;
    s.geometric_normal = dot(ng, s.to_viewer) < 0.0 ? -ng : ng;
    vec3 n = dot(normal_view, normal_view) > 0.0 ? normalize(normal_view) : s.geometric_normal;
    s.normal = dot(n, s.geometric_normal) < 0.0 ? -n : n;
    return s;
}
