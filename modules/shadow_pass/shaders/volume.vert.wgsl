// As volume.vert says.
#include "instance.wgsl"
#include "position.wgsl"

@vertex
fn main(@builtin(vertex_index) index: u32, @location(0) position: vec3f,
        instance: Instance) -> @invariant @builtin(position) vec4f {
    if ((index & 1u) == 0u) {
        return clip_position(clip_from_local(instance), vec4f(position, 1.0));
    }
    let far = position * instance.far_scale + instance.far_offset.xyz;
    return clip_position(clip_from_far(instance), vec4f(far, instance.far_offset.w));
}
