// The host's: a position by one matrix, and where it is in the world.
#version 450
layout(push_constant) uniform Thing {
    mat4 clip_from_local;
    vec4 world_from_local[3];  // rows
    vec4 albedo;
};
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 world;
invariant gl_Position;
void main() {
    vec4 p = vec4(position, 1.0);
    world = vec3(dot(world_from_local[0], p), dot(world_from_local[1], p), dot(world_from_local[2], p));
    gl_Position = clip_from_local * p;
}
