// Volumes write no colour.
@fragment
fn main() {}
