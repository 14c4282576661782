// The host's: ambient light, or that of its lamp.
#version 450
layout(constant_id = 0) const bool lamp_shines = false;
layout(push_constant) uniform Thing {
    mat4 clip_from_local;
    vec4 world_from_local[3];
    vec4 albedo;
};
layout(location = 0) in vec3 world;
layout(location = 0) out vec4 color;
const vec3 lamp = vec3(2.0, 4.0, 2.5);
void main() {
    vec3 n = normalize(cross(dFdy(world), dFdx(world)));  // y points down
    vec3 to_lamp = lamp - world;
    float lambert = max(dot(n, normalize(to_lamp)), 0.0) / dot(to_lamp, to_lamp);
    color = vec4(albedo.rgb * (lamp_shines ? vec3(20.0, 18.0, 14.0) * lambert : vec3(0.15)), 1.0);
}
