// What all vertices of one draw share: an element of a buffer that steps by instance, which the draw names by its first
// instance. The host's VolumeInstance.
layout(location = 1) in mat4 clip_from_local;
layout(location = 5) in mat4 clip_from_far;
layout(location = 9) in vec4 far_offset;
layout(location = 10) in float far_scale;
