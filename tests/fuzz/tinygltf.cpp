// SPDX-License-Identifier: MIT
//
// tinygltf and its image decoders compiled with the sanitizers, in place of Debian's shared
// libraries: a write beyond the end within them is then seen as well.
#define TINYGLTF_IMPLEMENTATION
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <tiny_gltf.h>
