// The scene's positions alone: for depth, and for its triangles as lines.
#include "position.wgsl"

struct Draw {
    clip_from_local: mat4x4f,
}
@group(0) @binding(1) var<uniform> draw: Draw;

@vertex
fn main(@location(0) position: vec3f) -> @invariant @builtin(position) vec4f {
    return clip_position(draw.clip_from_local, vec4f(position, 1.0));
}
