// As frame.glsl says.
struct Light {
    light_view: vec4f,  // xyz; w 1: a point, 0: direction towards the light
    color: vec4f,       // rgb radiance scale, exposure included
    spot_axis: vec4f,   // xyz the way the spot looks, w cosine of the outer cone (-2: no spot)
    spot_range: vec4f,  // x cosine of the inner cone, y range in metres (0: none), z 1: light that grazes fades
}

struct Frame {
    sky: vec4f,          // rgb, radiance
    ground: vec4f,       // rgb
    up_view: vec4f,      // xyz the world's up, w 1: perspective, 0: orthographic
    depth_range: vec4f,  // xy
    lit_by: vec4u,       // x lights in this round, y 1: and by what comes without a light
    lights: array<Light, 8>,
}
@group(1) @binding(0) var<uniform> frame: Frame;
