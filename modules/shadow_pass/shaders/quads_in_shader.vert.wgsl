// As quads_in_shader.vert says. A compiler may fuse the sum's products (WGSL has no `precise`): then a face that is all
// but edge-on comes out otherwise than on the CPU, for all its vertices alike.
#include "quads.wgsl"

// A plane a texel, bits of floats.
fn casts(face: u32) -> bool {
    let plane = bitcast<vec4f>(textureLoad(facing, texel(face), 0));
    let light = quads.light;
    let side = plane.x * light.x + plane.y * light.y + plane.z * light.z + plane.w * light.w;
    return select(side > 0.0, side < 0.0, quads.ranges.w != 0u);
}
