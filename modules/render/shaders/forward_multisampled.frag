// Forward shading of several samples at once, once a pixel: a light arrives in part, at as many of the fragment's samples
// as the mask lets it. What resolves is what shading each sample would give.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "forward.glsl"

layout(set = 3, binding = 5) uniform sampler2DMS light_mask;
layout(set = 3, binding = 6) uniform sampler2DMS fragment_depth;

// Which samples are this fragment's is not told by its coverage, for some may be hidden; but whose they are is written
// at each: the depth of its fragment, at the pixel's centre. Triangles that meet in a pixel at one depth share samples,
// light and sum.
vec4 share(ivec2 pixel) {
    float mine = gl_FragCoord.z;
    vec4 theirs = vec4(texelFetch(fragment_depth, pixel, 0).r, texelFetch(fragment_depth, pixel, 1).r,
                       texelFetch(fragment_depth, pixel, 2).r, texelFetch(fragment_depth, pixel, 3).r);
    vec4 own = vec4(lessThanEqual(abs(theirs - mine), vec4(1e-6 * abs(mine))));
    float count = dot(own, vec4(1.0));
    return count > 0.0 ? own / count : vec4(0.25);
}

vec4 shares;
uvec4 masks;

uint look_up_light() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    shares = share(pixel);
    masks = uvec4(vec4(texelFetch(light_mask, pixel, 0).r, texelFetch(light_mask, pixel, 1).r,
                       texelFetch(light_mask, pixel, 2).r, texelFetch(light_mask, pixel, 3).r) * 255.0 + 0.5);
    return ~(masks.x & masks.y & masks.z & masks.w);
}

float arriving(uint light) { return dot(shares, vec4(1u - (masks >> light & 1u))); }
