// What every draw of the report's own is told.
layout(set = 0, binding = 1) uniform Draw {
    mat4 clip_from_local;
    mat4 light_from_local;  // into the light's clip space, or its own space for a cube of maps
};
