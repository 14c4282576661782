// As geometry.vert says.
#include "position.wgsl"

struct Draw {
    clip_from_local: mat4x4f,
    view_from_local: mat4x4f,
    normal_matrix: mat4x4f,  // upper 3x3: cofactors, so that a flat scale still has normals
}
@group(0) @binding(1) var<uniform> draw: Draw;

struct Vertex {
    @invariant @builtin(position) clip: vec4f,
    @location(0) position_view: vec3f,
    @location(1) normal_view: vec3f,
    @location(2) uv: vec2f,
}

@vertex
fn main(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) texcoord: vec2f) -> Vertex {
    let normal_matrix = mat3x3f(draw.normal_matrix[0].xyz, draw.normal_matrix[1].xyz, draw.normal_matrix[2].xyz);
    var vertex: Vertex;
    vertex.clip = clip_position(draw.clip_from_local, vec4f(position, 1.0));
    vertex.position_view = (draw.view_from_local * vec4f(position, 1.0)).xyz;
    vertex.normal_view = normal_matrix * normal;
    vertex.uv = texcoord;
    return vertex;
}
