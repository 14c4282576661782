// What all surfaces of a frame share: what arrives without any light, and up to eight lights (a round; as
// internal/lighting.hpp has it).

struct Light {
    vec4 light_view;  // xyz; w 1: a point, 0: direction towards the light
    vec4 color;       // rgb radiance scale, exposure included
    vec4 spot_axis;   // xyz the way the spot looks, w cosine of the outer cone (-2: no spot)
    vec4 spot_range;  // x cosine of the inner cone, y range in metres (0: none), z 1: light that grazes fades
};

layout(set = 1, binding = 0) uniform Frame {
    vec4 sky;          // rgb, radiance
    vec4 ground;       // rgb
    vec4 up_view;      // xyz the world's up, w 1: perspective, 0: orthographic
    vec4 depth_range;  // xy
    uvec4 lit_by;      // x lights in this round, y 1: and by what comes without a light
    Light lights[8];
};
