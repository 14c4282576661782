// As quads.glsl says; the shader that includes this defines `casts()`.
#include "position.wgsl"

// Element i of a texture is at (i % 4096, i / 4096).
fn texel(i: u32) -> vec2u { return vec2u(i & 4095u, i >> 12u); }

struct Quads {
    clip_from_local: mat4x4f,
    clip_from_far: mat4x4f,
    far_offset: vec4f,
    far_scale: vec4f,  // x alone
    light: vec4f,      // as seen from the origin of the face planes
    ranges: vec4u,     // vertices of a side; first of the near caps; first of the far caps; 1: averted faces cast
}
@group(0) @binding(0) var<uniform> quads: Quads;
@group(1) @binding(1) var positions: texture_2d<u32>;  // bits of floats: x, y, z
@group(1) @binding(2) var edges: texture_2d<u32>;      // positions a and b; faces that run a -> b and b -> a
@group(1) @binding(3) var faces: texture_2d<u32>;      // three positions
@group(1) @binding(4) var facing: texture_2d<u32>;     // what casts() asks

fn quad_position(index: u32) -> vec4f {
    let averted = quads.ranges.w != 0u;
    var drawn: bool;
    var is_far: bool;
    var vertex: u32;
    if (index < quads.ranges.y) {
        let edge = textureLoad(edges, texel(index / quads.ranges.x), 0);
        let corner = index % quads.ranges.x;
        let along = casts(edge.z);
        drawn = along != casts(edge.w);
        let forward = along != averted;
        let first = select(edge.y, edge.x, forward);
        let last = select(edge.x, edge.y, forward);
        is_far = corner == 2u || corner >= 4u;
        vertex = select(first, last, corner == 0u || corner == 5u);
        if (corner == 2u && quads.ranges.x == 6u) { vertex = edge.y; }
        if (corner == 3u) { vertex = edge.x; }
    } else {
        is_far = index >= quads.ranges.z;
        let i = index - select(quads.ranges.y, quads.ranges.z, is_far);
        let face = textureLoad(faces, texel(i / 3u), 0);
        var corner = i % 3u;
        if (is_far && !averted) { corner = 2u - corner; }
        drawn = casts(i / 3u);
        vertex = face[corner];
    }
    if (!drawn) { return vec4f(2.0, 2.0, 2.0, 1.0); }  // outside, with all three corners
    let position = bitcast<vec3f>(textureLoad(positions, texel(vertex), 0).xyz);
    if (is_far) {
        let far = position * quads.far_scale.x + quads.far_offset.xyz;
        return clip_position(quads.clip_from_far, vec4f(far, quads.far_offset.w));
    }
    return clip_position(quads.clip_from_local, vec4f(position, 1.0));
}

@vertex
fn main(@builtin(vertex_index) index: u32) -> @invariant @builtin(position) vec4f {
    return quad_position(index);
}
