// At each sample whose it is: the depth of its fragment, at the pixel's centre (forward_multisampled.frag).
#version 450
layout(location = 0) out float fragment_depth;
void main() { fragment_depth = gl_FragCoord.z; }
