// As position.glsl says. WGSL has no `precise`: that volumes and scene get the same bits rests on `@invariant`, and on
// both calling this one function.
fn clip_position(clip_from_local: mat4x4f, p: vec4f) -> vec4f {
    return clip_from_local[0] * p.x + clip_from_local[1] * p.y + clip_from_local[2] * p.z + clip_from_local[3] * p.w;
}
