// A host's own way to a position: two matrices in turn.
#version 450
layout(location = 0) in vec3 position;
layout(push_constant) uniform Matrices {
    mat4 clip_from_world;
    mat4 world_from_local;
};
void main() {
    gl_Position = clip_from_world * (world_from_local * vec4(position, 1.0));
}
