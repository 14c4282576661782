// One triangle that covers the picture, as far away as depth goes: vertices 0 to 2 where that is 0, 3 to 5 where it is 1,
// 6 to 8 where it is -1.
#version 450
void main() {
    int v = gl_VertexIndex % 3;
    vec2 corner = vec2((v << 1) & 2, v & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, gl_VertexIndex < 3 ? 0.0 : gl_VertexIndex < 6 ? 1.0 : -1.0, 1.0);
}
