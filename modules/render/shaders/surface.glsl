// The surface under a fragment: its material and normals.

layout(set = 2, binding = 2) uniform Material {
    vec4 base_color;    // linear
    vec4 emissive;      // rgb
    vec4 parameters;    // x metallic, y roughness, z alpha cutoff (negative: opaque), w unused
};
layout(set = 2, binding = 3) uniform sampler2D base_color_texture;

layout(location = 0) in vec3 position_view;
layout(location = 1) in vec3 normal_view;
layout(location = 2) in vec2 uv;

// Leaves the fragment out where the material is cut out, and what lies outside `depth_range` (metres in front of the
// eye) where the pipeline does not clip (docs/conventions.md). Gives the base colour.
vec4 color_here(vec2 depth_range) {
    float depth = -position_view.z;
    if (depth < depth_range.x || depth > depth_range.y) discard;
    vec4 color = base_color * texture(base_color_texture, uv);
    if (color.a < parameters.z) discard;
    return color;
}
