// Depth alone, of what may have holes.
#include "surface.wgsl"
#include "frame.wgsl"

@fragment
fn main(at: Fragment) { color_here(at, frame.depth_range.xy); }
