// A flat colour over the picture: debug views.
struct Overlay {
    color: vec4f,
}
@group(1) @binding(4) var<uniform> overlay: Overlay;

@fragment
fn main() -> @location(0) vec4f { return overlay.color; }
