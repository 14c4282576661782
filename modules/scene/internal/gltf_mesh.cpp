// SPDX-License-Identifier: MIT
#include "internal/gltf_mesh.hpp"

#include <cmath>
#include <optional>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>

#include "internal/json_place.hpp"
#include "internal/mesh_normals.hpp"
#include "internal/mesh_origin.hpp"

namespace gnomon::scene::internal {
namespace {

std::optional<AccessorView> attribute(const GltfModel& model, const tinygltf::Primitive& primitive,
                                      const char* name) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    return AccessorView(model, found->second);
}

glm::vec3 read_vec3(const AccessorView& view, std::size_t i) {
    return {static_cast<float>(view.get(i, 0)), static_cast<float>(view.get(i, 1)),
            static_cast<float>(view.get(i, 2))};
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The corners of a primitive's triangles. Every second triangle of a strip is turned round, so
/// that all wind alike; triangles without area stay, as the file has them.
std::vector<std::uint32_t> triangulate(const std::vector<std::uint32_t>& list, PrimitiveMode mode) {
    if (mode == PrimitiveMode::Triangles) {
        return {list.begin(), list.end() - static_cast<std::ptrdiff_t>(list.size() % 3)};
    }
    std::vector<std::uint32_t> corners;
    if (list.size() < 3) return corners;
    corners.reserve((list.size() - 2) * 3);
    for (std::size_t i = 0; i + 2 < list.size(); ++i) {
        if (mode == PrimitiveMode::TriangleFan) {
            corners.insert(corners.end(), {list[0], list[i + 1], list[i + 2]});
        } else {
            const std::size_t odd = i % 2;
            corners.insert(corners.end(), {list[i], list[i + 1 + odd], list[i + 2 - odd]});
        }
    }
    return corners;
}

}  // namespace

/// The mesh under construction.
class MeshBuilder {
public:
    MeshBuilder(MeshReader& reader, int index, bool with_influences)
        : reader_(reader),
          source_(reader.model_.model.meshes[static_cast<std::size_t>(index)]),
          place_(fmt::format("meshes[{}]", index)),
          with_influences_(with_influences) {
        mesh_.name = source_.name;
    }

    BuiltMesh build() {
        for (std::size_t i = 0; i < source_.primitives.size(); ++i) {
            add_primitive(source_.primitives[i], fmt::format("{}.primitives[{}]", place_, i));
        }
        BuiltMesh result;
        for (const auto& primitive : source_.primitives) {
            if (!primitive.targets.empty()) result.has_morph_targets = true;
        }
        if (mesh_.indices.empty()) {
            message("has no triangles and is not drawn");
            return result;
        }
        if (const std::size_t count = repair_normals(mesh_); count > 0) {
            message(
                fmt::format("had {} normals that are zero or not finite; they were made from "
                            "the faces",
                            count));
        }
        if (!any_texcoords_) mesh_.texcoords.clear();
        if (any_influences_) result.influences = std::move(influences_);
        rebase_far_mesh(mesh_);
        result.mesh = std::make_shared<const Mesh>(std::move(mesh_));
        return result;
    }

private:
    /// A primitive's vertex data, where the file has it.
    struct Source {
        AccessorView position;
        std::optional<AccessorView> normal, texcoord, joints_0, joints_1, weights_0, weights_1;
        std::string place;
    };

    void message(const std::string& what) {
        reader_.messages_.push_back(
            fmt::format("{}: {} (\"{}\") {}.", reader_.model_.file, place_, source_.name, what));
    }

    void add_primitive(const tinygltf::Primitive& primitive, const std::string& place) {
        const GltfModel& model = reader_.model_;
        const auto mode = static_cast<PrimitiveMode>(primitive.mode);
        if (mode < PrimitiveMode::Triangles) {
            message(fmt::format("has {} in {}, which are skipped",
                                mode == PrimitiveMode::Points ? "points" : "lines", place));
            return;
        }
        auto position = attribute(model, primitive, "POSITION");
        if (!position) {
            message(fmt::format("has no POSITION in {}, which is skipped", place));
            return;
        }
        const Source source{*std::move(position),
                            attribute(model, primitive, "NORMAL"),
                            attribute(model, primitive, "TEXCOORD_0"),
                            attribute(model, primitive, "JOINTS_0"),
                            attribute(model, primitive, "JOINTS_1"),
                            attribute(model, primitive, "WEIGHTS_0"),
                            attribute(model, primitive, "WEIGHTS_1"),
                            place};
        const std::vector<std::uint32_t> corners =
            triangulate(read_indices(primitive, source), mode);
        const auto first = static_cast<std::uint32_t>(mesh_.indices.size());
        if (source.normal) {
            add_shared(source, corners, vertices_of(primitive));
        } else {
            add_flat(source, corners);
        }
        const auto count = static_cast<std::uint32_t>(mesh_.indices.size()) - first;
        // Material 0 of a scene is the default one; the file's follow it.
        if (count > 0) {
            mesh_.sub_meshes.push_back(
                {first, count, static_cast<std::uint32_t>(primitive.material + 1)});
        }
    }

    std::vector<std::uint32_t> read_indices(const tinygltf::Primitive& primitive,
                                            const Source& source) {
        const std::size_t vertex_count = source.position.count();
        std::vector<std::uint32_t> list;
        if (primitive.indices < 0) {
            reader_.spend(vertex_count, source.place);
            list.resize(vertex_count);
            for (std::size_t i = 0; i < vertex_count; ++i) list[i] = static_cast<std::uint32_t>(i);
        } else {
            const AccessorView indices(reader_.model_, primitive.indices);
            reader_.spend(indices.count(), source.place);
            list.resize(indices.count());
            for (std::size_t i = 0; i < list.size(); ++i) {
                list[i] = indices.get_index(i);
                if (list[i] >= vertex_count) {
                    refuse_input(
                        reader_.model_.file,
                        fmt::format("{}: element {} of its indices, accessors[{}], is {}, "
                                    "but must be less than {}, the number of vertices",
                                    source.place, i, primitive.indices, list[i], vertex_count));
                }
            }
        }
        const bool whole =
            primitive.mode != static_cast<int>(PrimitiveMode::Triangles) || list.size() % 3 == 0;
        if (!whole) {
            message(
                fmt::format("has {} indices in {}, which is not a multiple of three; the last "
                            "are left out",
                            list.size(), source.place));
        }
        return list;
    }

    std::uint32_t add_vertex(const Source& source, std::size_t i) {
        const glm::vec3 position = read_vec3(source.position, i);
        if (!is_finite(position)) {
            refuse_input(reader_.model_.file,
                         fmt::format("{}: POSITION {} is ({}, {}, {}), but must be finite",
                                     source.place, i, position.x, position.y, position.z));
        }
        mesh_.positions.push_back(position);
        mesh_.normals.push_back(source.normal ? read_vec3(*source.normal, i) : glm::vec3(0.0F));
        glm::vec2 texcoord(0.0F);
        if (source.texcoord) {
            any_texcoords_ = true;
            texcoord = {static_cast<float>(source.texcoord->get(i, 0)),
                        static_cast<float>(source.texcoord->get(i, 1))};
        }
        mesh_.texcoords.push_back(texcoord);
        if (with_influences_) influences_.push_back(read_influence(source, i));
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    Influence read_influence(const Source& source, std::size_t i) {
        Influence influence;
        const auto read = [&](const std::optional<AccessorView>& joints,
                              const std::optional<AccessorView>& weights, std::size_t first) {
            if (!joints || !weights) return;
            any_influences_ = true;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto weight = static_cast<float>(weights->get(i, k));
                influence.joints[first + k] = static_cast<std::uint32_t>(joints->get(i, k));
                influence.weights[first + k] = std::isfinite(weight) ? weight : 0.0F;
            }
        };
        read(source.joints_0, source.weights_0, 0);
        read(source.joints_1, source.weights_1, 4);
        return influence;
    }

    /// glTF's rule for primitives without normals: flat faces, which share no vertex.
    void add_flat(const Source& source, const std::vector<std::uint32_t>& corners) {
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            const std::uint32_t first = add_vertex(source, corners[i]);
            add_vertex(source, corners[i + 1]);
            add_vertex(source, corners[i + 2]);
            const glm::vec3 normal = face_normal(mesh_.positions[first], mesh_.positions[first + 1],
                                                 mesh_.positions[first + 2]);
            for (std::uint32_t k = first; k < first + 3; ++k) {
                mesh_.normals[k] = normal;
                mesh_.indices.push_back(k);
            }
        }
    }

    using VertexMap = std::unordered_map<std::uint32_t, std::uint32_t>;

    void add_shared(const Source& source, const std::vector<std::uint32_t>& corners,
                    VertexMap& vertices) {
        for (const std::uint32_t corner : corners) {
            auto [place, is_new] = vertices.try_emplace(corner, 0);
            if (is_new) place->second = add_vertex(source, corner);
            mesh_.indices.push_back(place->second);
        }
    }

    /// Primitives with the very same vertex data share their vertices. Unused vertices are dropped.
    VertexMap& vertices_of(const tinygltf::Primitive& primitive) {
        return vertex_maps_[primitive.attributes];
    }

    MeshReader& reader_;
    const tinygltf::Mesh& source_;
    std::string place_;
    bool with_influences_;
    Mesh mesh_;
    std::vector<Influence> influences_;
    std::map<std::map<std::string, int>, VertexMap> vertex_maps_;
    bool any_texcoords_ = false;
    bool any_influences_ = false;
};

MeshReader::MeshReader(const GltfModel& model, std::vector<std::string>& messages)
    : model_(model), messages_(messages), limit_(std::size_t{1} << 24U) {
    for (const auto& buffer : model.buffers) limit_ += 16 * buffer.size();
}

const BuiltMesh& MeshReader::read(int mesh, bool with_influences) {
    const auto found = built_.find(mesh);
    if (found != built_.end()) return found->second;
    return built_[mesh] = MeshBuilder(*this, mesh, with_influences).build();
}

void MeshReader::spend(std::size_t elements, const std::string& place) {
    spent_ += elements;
    if (spent_ > limit_) {
        refuse_input(model_.file,
                     fmt::format("{} brings the vertices and indices of all meshes to {}, but a "
                                 "file of this size may have at most {}",
                                 place, spent_, limit_));
    }
}

}  // namespace gnomon::scene::internal
