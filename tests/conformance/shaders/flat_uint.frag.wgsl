@fragment
fn main(@location(0) v_color: vec4f) -> @location(0) u32 { return u32(v_color.r + 0.5); }
