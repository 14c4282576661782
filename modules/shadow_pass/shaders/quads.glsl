// A shadow volume from quads on every edge (gnomon/shadows/edge_quads.hpp, quad_vertex(), says the same in C++). No
// vertex is given: its number says which corner of which triangle it is, and textures hold what it needs. The shader
// that includes this defines `bool casts(uint face)`; it must answer by the face alone, so that all vertices that ask
// get the same answer.

// Element i of a texture is at (i % 4096, i / 4096).
ivec2 texel(uint i) { return ivec2(int(i & 4095u), int(i >> 12)); }

layout(set = 0, binding = 0) uniform Quads {
    mat4 clip_from_local;
    mat4 clip_from_far;
    vec4 far_offset;
    vec4 far_scale;  // x alone
    vec4 light;      // as seen from the origin of the face planes
    uvec4 ranges;    // vertices of a side; first of the near caps; first of the far caps; 1: averted faces cast
};
layout(set = 1, binding = 1) uniform usampler2D positions;  // bits of floats: x, y, z
layout(set = 1, binding = 2) uniform usampler2D edges;      // positions a and b; faces that run a -> b and b -> a
layout(set = 1, binding = 3) uniform usampler2D faces;      // three positions
layout(set = 1, binding = 4) uniform usampler2D facing;     // what casts() asks

bool casts(uint face);

out gl_PerVertex {
    invariant vec4 gl_Position;
};

vec4 quad_position() {
    uint i = uint(gl_VertexIndex);
    bool averted = ranges.w != 0u;
    bool drawn;
    bool is_far;
    uint vertex;
    if (i < ranges.y) {
        uvec4 edge = texelFetch(edges, texel(i / ranges.x), 0);
        uint corner = i % ranges.x;
        bool along = casts(edge.z);
        drawn = along != casts(edge.w);
        bool forward = along != averted;
        uint from = forward ? edge.x : edge.y;
        uint to = forward ? edge.y : edge.x;
        is_far = corner == 2u || corner >= 4u;
        vertex = corner == 0u || corner == 5u ? to : from;
        if (corner == 2u && ranges.x == 6u) vertex = edge.y;
        if (corner == 3u) vertex = edge.x;
    } else {
        is_far = i >= ranges.z;
        i -= is_far ? ranges.z : ranges.y;
        uvec4 face = texelFetch(faces, texel(i / 3u), 0);
        uint corner = i % 3u;
        if (is_far && !averted) corner = 2u - corner;
        drawn = casts(i / 3u);
        vertex = face[corner];
    }
    if (!drawn) return vec4(2.0, 2.0, 2.0, 1.0);  // outside, with all three corners
    vec3 position = uintBitsToFloat(texelFetch(positions, texel(vertex), 0).xyz);
    if (is_far) {
        precise vec3 far = position * far_scale.x + far_offset.xyz;
        return clip_position(clip_from_far, vec4(far, far_offset.w));
    }
    return clip_position(clip_from_local, vec4(position, 1.0));
}
