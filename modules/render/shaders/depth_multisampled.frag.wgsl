// As depth_multisampled.frag says.
#include "surface.wgsl"
#include "frame.wgsl"

@fragment
fn main(at: Fragment) -> @location(0) f32 {
    color_here(at, frame.depth_range.xy);
    return at.pixel.z;
}
