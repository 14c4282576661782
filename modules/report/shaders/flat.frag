#version 450
layout(location = 0) in float height_m;
layout(location = 0) out vec4 shadow;
void main() {
    if (height_m < 0.0) discard;
    shadow = vec4(1.0);
}
