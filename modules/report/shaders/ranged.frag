// Leaves out what a perspective would have clipped.
#version 450
layout(location = 0) in vec2 range_m;
void main() {
    float depth_m = 1.0 / gl_FragCoord.w;
    if (depth_m < range_m.x || depth_m > range_m.y) discard;
}
