// Depth alone, cut off at the near and the far plane, where the pipeline does not clip.
#version 450
layout(location = 0) in vec2 in_front;
void main() {
    if (min(in_front.x, in_front.y) < 0.0) discard;
}
