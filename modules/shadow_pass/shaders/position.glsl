// The one place where a clip position is computed: for the scene and for the volumes alike, so that a near cap and the
// surface it lies on get the same bits (docs/conventions.md, "One position function").
// p: caster space, homogeneous; w = 1 for a point, 0 for a direction (a point at infinity).
vec4 clip_position(mat4 clip_from_local, vec4 p) {
    precise vec4 clip = clip_from_local[0] * p.x + clip_from_local[1] * p.y + clip_from_local[2] * p.z +
                        clip_from_local[3] * p.w;
    return clip;
}
