// SPDX-License-Identifier: MIT
//
// What shadows a picture has, by rays in double precision against every triangle: slow, plain, and nothing of gnomon's.

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/// Triangles of `positions` and `indices` where the pose takes them.
export function placed(positions, indices, pose) {
    const corner = i => [0, 1, 2].map(r => pose[r] * positions[3 * i] + pose[4 + r] * positions[3 * i + 1] +
                                           pose[8 + r] * positions[3 * i + 2] + pose[12 + r]);
    const triangles = [];
    for (let t = 0; t < indices.length; t += 3) {
        const [a, b, c] = [corner(indices[t]), corner(indices[t + 1]), corner(indices[t + 2])];
        triangles.push({a, ab: sub(b, a), ac: sub(c, a)});
    }
    return triangles;
}

/// Where along the ray from `from` by `way` a triangle is met; NaN where it is not. After Möller and Trumbore.
function met({a, ab, ac}, from, way) {
    const p = cross(way, ac);
    const det = dot(ab, p);
    if (det === 0) return NaN;
    const s = sub(from, a);
    const u = dot(s, p) / det;
    if (u < 0 || u > 1) return NaN;
    const q = cross(s, ab);
    const v = dot(way, q) / det;
    if (v < 0 || u + v > 1) return NaN;
    return dot(ac, q) / det;
}

/// Bits of the lights that do not arrive at what is seen along the ray, and which triangle that is; -1 for nothing.
function seen(triangles, casters, lights, eye, way) {
    let nearest = Infinity;
    let which = -1;
    triangles.forEach((triangle, i) => {
        const t = met(triangle, eye, way);
        if (t > 0 && t < nearest) [nearest, which] = [t, i];
    });
    if (which < 0) return {which, bits: 0};
    const point = eye.map((v, i) => v + nearest * way[i]);
    let bits = 0;
    lights.forEach((light, l) => {
        if (light === null) return;  // gone: its bit is 0
        const to = light.direction ? light.direction.map(v => -1e3 * v) : sub(light.position, point);
        if (casters.some(triangle => {
            const t = met(triangle, point, to);
            return t > 1e-9 && t < 1;
        })) bits |= 1 << l;
    });
    return {which, bits: bits >>> 0};
}

/// By pixel, what is seen at `offset` from its corner; null where that or its bits differ within `band` pixels. `rays(x, y)`
/// gives the eye and the way through a place of the picture.
export function truth({triangles, casters, lights, width, height, rays, band, offset}) {
    const result = [];
    const places = (band === 0 ? [[0, 0]] : [[0, 0], [band, 0], [-band, 0], [0, band], [0, -band], [band, band], [-band, band], [band, -band], [-band, -band]]);
    for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
            let first = null;
            const clear = places.every(([dx, dy]) => {
                const {eye, way} = rays(x + offset[0] + dx, y + offset[1] + dy);
                const at = seen(triangles, casters, lights, eye, way);
                first ??= at;
                return at.which === first.which && at.bits === first.bits;
            });
            result.push(clear ? first : null);
        }
    }
    return result;
}
