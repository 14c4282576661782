// Dear ImGui's vertices: pixels from the upper left corner, to clip space.
#version 450
layout(set = 0, binding = 0) uniform Frame {
    vec2 clip_from_pixels_scale;
    vec2 clip_from_pixels_offset;
};
layout(location = 0) in vec2 position_px;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
layout(location = 0) out vec2 fragment_uv;
layout(location = 1) out vec4 fragment_color;
void main() {
    fragment_uv = uv;
    fragment_color = color;
    gl_Position = vec4(position_px * clip_from_pixels_scale + clip_from_pixels_offset, 0.0, 1.0);
}
