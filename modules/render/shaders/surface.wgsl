// As surface.glsl says.
struct Material {
    base_color: vec4f,  // linear
    emissive: vec4f,    // rgb
    parameters: vec4f,  // x metallic, y roughness, z alpha cutoff (negative: opaque), w unused
}
@group(2) @binding(2) var<uniform> material: Material;
@group(2) @binding(3) var base_color_texture: texture_2d<f32>;
@group(2) @binding(103) var base_color_texture_sampler: sampler;

struct Fragment {
    @builtin(position) pixel: vec4f,
    @location(0) position_view: vec3f,
    @location(1) normal_view: vec3f,
    @location(2) uv: vec2f,
}

fn color_here(at: Fragment, depth_range: vec2f) -> vec4f {
    let depth = -at.position_view.z;
    if (depth < depth_range.x || depth > depth_range.y) { discard; }
    let color = material.base_color * textureSample(base_color_texture, base_color_texture_sampler, at.uv);
    if (color.a < material.parameters.z) { discard; }
    return color;
}
