// As fragment_depth.frag says.
@fragment
fn main(@builtin(position) pixel: vec4f) -> @location(0) f32 { return pixel.z; }
