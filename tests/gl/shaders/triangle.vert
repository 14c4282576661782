#version 450
// A triangle over the left part of the top half of the picture, wound counter-clockwise.
layout(location = 0) out vec3 v_color;

void main() {
    vec2 corners[3] = vec2[](vec2(-1.0, 0.0), vec2(1.0, 0.0), vec2(-1.0, 1.0));
    gl_Position = vec4(corners[gl_VertexIndex], 0.5, 1.0);
    v_color = vec3(1.0, 0.5, 0.0);
}
