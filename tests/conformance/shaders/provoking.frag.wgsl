@fragment
fn main(@location(0) @interpolate(flat, first) v_color: vec4f) -> @location(0) vec4f { return v_color; }
