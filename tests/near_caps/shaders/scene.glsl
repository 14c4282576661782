// What the host's two vertex shaders share: everything but the position expression.
layout(set = 0, binding = 0) uniform Draw {
    mat4 clip_from_local;
    mat4 clip_from_view;
    mat4 view_from_world;
    mat4 world_from_local;
    vec4 depth_range;  // xy metres in front of the eye
};

layout(location = 0) in vec3 position;
layout(location = 0) out vec2 in_front;  // metres behind the near plane, metres before the far one
