// As instance.glsl says; a matrix comes as its columns.
struct Instance {
    @location(1) clip_from_local_0: vec4f,
    @location(2) clip_from_local_1: vec4f,
    @location(3) clip_from_local_2: vec4f,
    @location(4) clip_from_local_3: vec4f,
    @location(5) clip_from_far_0: vec4f,
    @location(6) clip_from_far_1: vec4f,
    @location(7) clip_from_far_2: vec4f,
    @location(8) clip_from_far_3: vec4f,
    @location(9) far_offset: vec4f,
    @location(10) far_scale: f32,
}

fn clip_from_local(i: Instance) -> mat4x4f {
    return mat4x4f(i.clip_from_local_0, i.clip_from_local_1, i.clip_from_local_2, i.clip_from_local_3);
}

fn clip_from_far(i: Instance) -> mat4x4f {
    return mat4x4f(i.clip_from_far_0, i.clip_from_far_1, i.clip_from_far_2, i.clip_from_far_3);
}
