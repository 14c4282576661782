// A flat colour over the picture: debug views.
#version 450
layout(set = 1, binding = 4) uniform Overlay {
    vec4 color;
};
layout(location = 0) out vec4 radiance;
void main() {
    radiance = color;
}
