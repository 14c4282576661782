// As quads_uploaded.vert says.
#include "quads.wgsl"

// 32 faces a texel.
fn casts(face: u32) -> bool {
    return ((textureLoad(facing, texel(face >> 5u), 0).x >> (face & 31u)) & 1u) != 0u;
}
