// SPDX-License-Identifier: MIT
#include "internal/gltf_mesh.hpp"

#include <algorithm>
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

    std::shared_ptr<const Mesh> build() {
        prepare_deformation();
        for (std::size_t i = 0; i < source_.primitives.size(); ++i) {
            add_primitive(source_.primitives[i], fmt::format("{}.primitives[{}]", place_, i));
        }
        if (mesh_.indices.empty()) {
            message("has no triangles and is not drawn");
            return nullptr;
        }
        if (const std::size_t count = repair_normals(mesh_.normals, mesh_.positions, mesh_.indices);
            count > 0) {
            message(
                fmt::format("had {} normals that are zero or not finite; they were made from "
                            "the faces",
                            count));
        }
        if (!any_texcoords_) mesh_.texcoords.clear();
        rebase_far_mesh(mesh_);
        add_deformation();
        return std::make_shared<const Mesh>(std::move(mesh_));
    }

private:
    /// JOINTS_n and WEIGHTS_n.
    struct InfluenceSet {
        AccessorView joints, weights;
    };
    struct Target {
        std::optional<AccessorView> position, normal;
    };
    /// A primitive's vertex data, where the file has it.
    struct Source {
        AccessorView position;
        std::optional<AccessorView> normal, texcoord;
        std::vector<InfluenceSet> influences;
        std::vector<Target> targets;
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
                            influence_sets(primitive),
                            targets_of(primitive),
                            place};
        const std::vector<std::uint32_t> corners =
            triangulate(read_indices(primitive, source), mode);
        // At most this many vertices are new; each has numbers besides its position.
        const std::size_t vertices =
            source.normal ? std::min(corners.size(), source.position.count()) : corners.size();
        reader_.spend(vertices * (8 * influence_set_count_ + 2 * source.targets.size()), place);
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
        add_influences(source, i);
        add_deltas(source, i);
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    [[nodiscard]] std::vector<InfluenceSet> influence_sets(
        const tinygltf::Primitive& primitive) const {
        std::vector<InfluenceSet> sets;
        if (!with_influences_) return sets;
        for (std::size_t n = 0;; ++n) {
            auto joints = attribute(reader_.model_, primitive, fmt::format("JOINTS_{}", n).c_str());
            auto weights =
                attribute(reader_.model_, primitive, fmt::format("WEIGHTS_{}", n).c_str());
            if (!joints || !weights) return sets;
            sets.push_back({*std::move(joints), *std::move(weights)});
        }
    }

    [[nodiscard]] std::vector<Target> targets_of(const tinygltf::Primitive& primitive) const {
        std::vector<Target> targets;
        for (const auto& attributes : primitive.targets) {
            const auto view = [&](const char* name) -> std::optional<AccessorView> {
                const auto found = attributes.find(name);
                if (found == attributes.end()) return std::nullopt;
                return AccessorView(reader_.model_, found->second);
            };
            targets.push_back({view("POSITION"), view("NORMAL")});
        }
        return targets;
    }

    /// What all primitives together have: a vertex has as many influences and deltas as any other.
    void prepare_deformation() {
        std::size_t target_count = 0;
        for (const auto& primitive : source_.primitives) {
            influence_set_count_ = std::max(influence_set_count_, influence_sets(primitive).size());
            target_count = std::max(target_count, primitive.targets.size());
        }
        deformation_.influences_per_vertex = 4 * influence_set_count_;
        deformation_.targets.resize(target_count);
        has_deltas_.resize(target_count);
        for (const auto& primitive : source_.primitives) {
            for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
                has_deltas_[t].positions |= primitive.targets[t].contains("POSITION");
                has_deltas_[t].normals |= primitive.targets[t].contains("NORMAL");
            }
        }
    }

    void add_influences(const Source& source, std::size_t i) {
        for (std::size_t n = 0; n < influence_set_count_; ++n) {
            for (std::size_t k = 0; k < 4; ++k) {
                const bool is_there = n < source.influences.size();
                deformation_.joints.push_back(
                    is_there ? static_cast<std::uint32_t>(source.influences[n].joints.get(i, k))
                             : 0);
                const float weight =
                    is_there ? static_cast<float>(source.influences[n].weights.get(i, k)) : 0.0F;
                if (!std::isfinite(weight) || weight < 0.0F) {
                    refuse_input(reader_.model_.file,
                                 fmt::format("{}: component {} of WEIGHTS_{} {} is {}, but must be "
                                             "finite and not negative",
                                             source.place, k, n, i, weight));
                }
                deformation_.weights.push_back(weight);
            }
        }
    }

    void add_deltas(const Source& source, std::size_t i) {
        for (std::size_t t = 0; t < deformation_.targets.size(); ++t) {
            const auto read = [&](const std::optional<AccessorView>& view, const char* name) {
                const glm::vec3 delta = view ? read_vec3(*view, i) : glm::vec3(0.0F);
                if (!is_finite(delta)) {
                    refuse_input(reader_.model_.file,
                                 fmt::format("{}.targets[{}]: {} {} is ({}, {}, {}), but must be "
                                             "finite",
                                             source.place, t, name, i, delta.x, delta.y, delta.z));
                }
                return delta;
            };
            const Target& target = source.targets[t];
            MorphTarget& into = deformation_.targets[t];
            if (has_deltas_[t].positions)
                into.positions.push_back(read(target.position, "POSITION"));
            if (has_deltas_[t].normals) into.normals.push_back(read(target.normal, "NORMAL"));
        }
    }

    void add_deformation() {
        if (influence_set_count_ == 0 && deformation_.targets.empty()) return;
        deformation_.default_weights = source_.weights;
        auto made = make_mesh_deformation(mesh_, std::move(deformation_));
        if (!made)
            refuse_input(reader_.model_.file, fmt::format("{}: {}", place_, made.error().message));
        mesh_.deformation = *std::move(made);
    }

    /// glTF's rule for primitives without normals: flat faces, which share no vertex.
    void add_flat(const Source& source, const std::vector<std::uint32_t>& corners) {
        deformation_.flat.push_back({static_cast<std::uint32_t>(mesh_.positions.size()),
                                     static_cast<std::uint32_t>(corners.size())});
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
        return vertex_maps_[{primitive.attributes, primitive.targets}];
    }

    MeshReader& reader_;
    const tinygltf::Mesh& source_;
    std::string place_;
    bool with_influences_;
    Mesh mesh_;
    using Attributes = std::map<std::string, int>;
    std::map<std::pair<Attributes, std::vector<Attributes>>, VertexMap> vertex_maps_;
    MeshDeformationSource deformation_;
    struct HasDeltas {
        bool positions = false;
        bool normals = false;
    };
    std::vector<HasDeltas> has_deltas_;  // by target: in any primitive
    std::size_t influence_set_count_ = 0;
    bool any_texcoords_ = false;
};

MeshReader::MeshReader(const GltfModel& model, std::vector<std::string>& messages)
    : model_(model), messages_(messages), limit_(std::size_t{1} << 24U) {
    for (const auto& buffer : model.buffers) limit_ += 16 * buffer.size();
}

const std::shared_ptr<const Mesh>& MeshReader::read(int mesh, bool with_influences) {
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
