// As volume_extruded.vert says.
#include "instance.wgsl"
#include "position.wgsl"

@vertex
fn main(@builtin(vertex_index) index: u32, @location(0) position: vec4f,
        instance: Instance) -> @invariant @builtin(position) vec4f {
    if ((index & 1u) == 0u) {
        return clip_position(clip_from_local(instance), vec4f(position.xyz, 1.0));
    }
    return clip_position(clip_from_far(instance), position);
}
