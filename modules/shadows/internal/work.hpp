// SPDX-License-Identifier: MIT
//
// What the steps of detecting take, so that ways can be compared by what they looked at. It is
// counted rather than timed: the same frames make the same choices, whatever else the machine does.
#pragma once

#include <cstddef>

namespace gnomon::shadows::internal {

// Nanoseconds, as fitted to runs of the benchmark's meshes in one processor's caches. They are only
// compared with each other: their ratios have to hold elsewhere, not they.
namespace work {
inline constexpr double call = 150.0;         // finding castings, setting up
inline constexpr double block_of_mesh = 0.4;  // of faces: casting bits, looking for edge-on ones
inline constexpr double face_node = 60.0;     // a node of eight boxes
inline constexpr double edge_node = 37.0;     // the same
inline constexpr double searched_face_block = 18.0;
inline constexpr double searched_edge_block = 15.0;
inline constexpr double face_block_in_turn = 11.0;
inline constexpr double edge_block_in_turn = 9.5;
inline constexpr double silhouette_edge = 7.0;  // found in either way
inline constexpr double new_certificate =
    6.0;  // of a block: written, and entered in the tournament
inline constexpr double renewed_block = 60.0;
inline constexpr double renewed_edge = 12.0;

inline double search_of_faces(std::size_t nodes, std::size_t blocks) {
    return face_node * static_cast<double>(nodes) +
           searched_face_block * static_cast<double>(blocks);
}
inline double search_of_edges(std::size_t nodes, std::size_t blocks) {
    return edge_node * static_cast<double>(nodes) +
           searched_edge_block * static_cast<double>(blocks);
}
/// What comes on top of deciding faces and edges.
inline double of_detection(std::size_t face_blocks, std::size_t silhouette) {
    return call + block_of_mesh * static_cast<double>(face_blocks) +
           silhouette_edge * static_cast<double>(silhouette);
}
}  // namespace work

}  // namespace gnomon::shadows::internal
