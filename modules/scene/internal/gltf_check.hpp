// SPDX-License-Identifier: MIT
//
// Checks the JSON of a glTF file before anything uses it: types of members, ranges of numbers,
// every reference, every byte range, the shape of the node graph. What passes can be read without
// further checks, except for what only the bytes of the buffers tell (indices, finite positions).
//
// It is not a validator of the specification: what no reader here looks at is not checked.
#pragma once

#include "internal/gltf_file.hpp"
#include "internal/json_place.hpp"

namespace gnomon::scene::internal {

/// Throws InputError.
void check_gltf(const GltfFile& file);

/// The pieces of check_gltf that are about nodes: cameras, lights, skins, nodes, scenes.
void check_node_graph(const JsonPlace& root);

/// For both halves: the elements of a top-level array, none when it is absent. Each is an object
/// whose name, if any, is a text.
[[nodiscard]] std::vector<JsonPlace> elements_of(const JsonPlace& root, const std::string& array);
/// Refused unless `place` is the index of an element of that top-level array.
std::size_t check_reference(const JsonPlace& root, const JsonPlace& place,
                            const std::string& array);
/// How many morph targets a checked mesh has: as many in each of its primitives.
[[nodiscard]] std::size_t morph_target_count(const JsonPlace& mesh);
/// Refused unless it is an array of as many numbers.
void check_morph_weights(const JsonPlace& weights, std::size_t targets);
/// place.extensions.NAME, when there.
[[nodiscard]] std::optional<JsonPlace> find_extension(const JsonPlace& place,
                                                      const std::string& name);
/// Refused unless the accessor has one of these "TYPE componentType" pairs, such as
/// {"VEC3", {5126}}; returns its count.
std::uint64_t check_accessor_kind(const JsonPlace& root, const JsonPlace& reference,
                                  std::string_view type,
                                  std::initializer_list<int> component_types);

}  // namespace gnomon::scene::internal
