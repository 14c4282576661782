// A colour, as much of it as the font atlas covers; premultiplied, so that blending needs no alpha of the target's.
#version 450
layout(set = 0, binding = 1) uniform sampler2D atlas;
layout(location = 0) in vec2 fragment_uv;
layout(location = 1) in vec4 fragment_color;
layout(location = 0) out vec4 display;
void main() {
    float alpha = fragment_color.a * texture(atlas, fragment_uv).r;
    display = vec4(fragment_color.rgb * alpha, alpha);
}
