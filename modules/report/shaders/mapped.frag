// 1 where the shadow map says that something is nearer to the light. Depth in the map is reversed: 1 near, 0 far.
#version 450

layout(set = 1, binding = 0) uniform Map {
    vec4 size;  // x texels of a map, y 1: six maps as a cube, z its near plane in metres, w 1: 3x3 texels are asked
    vec4 bias;  // x depth, y part of the depth: both away from the light
};
layout(set = 1, binding = 2) uniform sampler2D map;

layout(location = 0) in vec4 position_light;
layout(location = 0) out vec4 shadow;

void main() {
    vec2 at;  // -1..1, y up
    float depth;
    ivec2 corner = ivec2(0);
    if (size.y > 0.5) {
        vec3 p = position_light.xyz;
        vec3 a = abs(p);
        float far;
        int face;
        if (a.x >= a.y && a.x >= a.z) {
            far = a.x;
            face = p.x > 0.0 ? 0 : 1;
            at = vec2(p.x > 0.0 ? p.z : -p.z, p.y);
        } else if (a.y >= a.z) {
            far = a.y;
            face = p.y > 0.0 ? 2 : 3;
            at = vec2(p.x, p.y > 0.0 ? p.z : -p.z);
        } else {
            far = a.z;
            face = p.z > 0.0 ? 4 : 5;
            at = vec2(p.z > 0.0 ? -p.x : p.x, p.y);
        }
        at /= far;
        depth = size.z / far;
        corner = ivec2(face % 3, face / 3) * int(size.x);
    } else {
        at = position_light.xy / position_light.w;
        depth = position_light.z / position_light.w;
        if (position_light.w <= 0.0 || any(greaterThan(abs(at), vec2(1.0)))) {
            shadow = vec4(0.0);  // beyond the map everything is lit
            return;
        }
    }
    depth = depth * (1.0 + bias.y) + bias.x;
    ivec2 texel = ivec2(floor(vec2(at.x * 0.5 + 0.5, 0.5 - at.y * 0.5) * size.x));
    int reach = size.w > 0.5 ? 1 : 0;
    float behind = 0.0;
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            ivec2 place = clamp(texel + ivec2(x, y), ivec2(0), ivec2(int(size.x) - 1));
            behind += texelFetch(map, corner + place, 0).r > depth ? 1.0 : 0.0;
        }
    }
    float asked = float((2 * reach + 1) * (2 * reach + 1));
    shadow = vec4(behind * 2.0 > asked ? 1.0 : 0.0);
}
