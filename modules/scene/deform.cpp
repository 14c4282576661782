// SPDX-License-Identifier: MIT
#include <gnomon/scene/deform.hpp>

#include <atomic>
#include <cmath>
#include <cstring>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "internal/mesh_normals.hpp"
#include "internal/mesh_origin.hpp"

namespace gnomon::scene {
namespace {

std::uint64_t next_revision() {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(1);
}

/// As update_world_transforms sees it: a parent without LocalTransform counts as the world.
std::optional<Entity> posed_parent(const Registry& registry, Entity entity) {
    const auto* parent = registry.try_get<Parent>(entity);
    if (parent == nullptr || !registry.has<LocalTransform>(parent->value)) return std::nullopt;
    return parent->value;
}

/// Poses of nodes in the space of one of their ancestors, each worked out once.
class PosesBelow {
public:
    PosesBelow(const Registry& registry, std::optional<Entity> space)
        : registry_(registry), space_(space) {}

    const glm::dmat4& of(Entity node) {
        chain_.clear();
        glm::dmat4 pose(1.0);
        for (std::optional<Entity> next = node; next && next != space_;
             next = posed_parent(registry_, *next)) {
            if (const auto known = known_.find(next->index); known != known_.end()) {
                pose = known->second;
                break;
            }
            chain_.push_back(*next);
            GNOMON_EXPECTS(chain_.size() <= registry_.size());  // else: a cycle of parents
        }
        for (auto entity = chain_.rbegin(); entity != chain_.rend(); ++entity) {
            pose = pose * registry_.get<LocalTransform>(*entity).parent_from_local();
            known_[entity->index] = pose;
        }
        return known_.try_emplace(node.index, pose).first->second;
    }

private:
    const Registry& registry_;
    std::optional<Entity> space_;
    std::unordered_map<std::uint32_t, glm::dmat4> known_;
    std::vector<Entity> chain_;
};

/// Where an instance's vertices come from: all that Deformed depends on but the mesh.
struct Inputs {
    std::vector<double> weights;     // of morph targets
    std::vector<glm::dmat4> joints;  // pose * inverse bind matrix; empty: not skinned

    [[nodiscard]] std::vector<double> flattened() const {
        std::vector<double> all = weights;
        for (const glm::dmat4& joint : joints) {
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 4; ++row) all.push_back(joint[column][row]);
            }
        }
        return all;
    }
};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Cofactors: the inverse transpose times the determinant, which singular matrices have too.
glm::dvec3 transformed_normal(const glm::dmat4& matrix, const glm::dvec3& normal) {
    const glm::dvec3 x(matrix[0]);
    const glm::dvec3 y(matrix[1]);
    const glm::dvec3 z(matrix[2]);
    return glm::cross(y, z) * normal.x + glm::cross(z, x) * normal.y + glm::cross(x, y) * normal.z;
}

class Evaluation {
public:
    Evaluation(const Mesh& mesh, const Inputs& inputs)
        : mesh_(mesh), deformation_(*mesh.deformation), inputs_(inputs) {
        const std::size_t count = mesh.positions.size();
        positions_.resize(count);
        normals_.resize(count);
        for (std::size_t v = 0; v < count; ++v) {
            positions_[v] = mesh.origin + glm::dvec3(mesh.positions[v]);
            normals_[v] = mesh.normals[v];
        }
        morph();
        if (!inputs.joints.empty()) skin();
    }

    /// Rounds, near an origin of its own. Gives the first vertex that is not finite, if any.
    std::optional<std::size_t> store(Deformed& into) const {
        Bounds bounds;
        for (const glm::dvec3& position : positions_) bounds.include(position);
        into.origin = internal::near_origin(bounds);
        into.positions.resize(positions_.size());
        into.normals.resize(positions_.size());
        for (std::size_t v = 0; v < positions_.size(); ++v) {
            const glm::vec3 p(positions_[v] - into.origin);
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return v;
            into.positions[v] = p;
            const double length = glm::length(normals_[v]);
            const bool good = length > 0.0 && std::isfinite(length);
            into.normals[v] = good ? glm::vec3(normals_[v] / length) : glm::vec3(0.0F);
        }
        for (const VertexRange& range : deformation_.flat) {
            for (std::uint32_t k = 0; k < range.count; ++k) {
                into.normals[range.first + k] = glm::vec3(0.0F);  // made from the face below
            }
        }
        internal::repair_normals(into.normals, into.positions, mesh_.indices);
        return std::nullopt;
    }

private:
    void morph() {
        for (std::size_t t = 0; t < deformation_.targets.size(); ++t) {
            const double weight = inputs_.weights[t];
            if (weight == 0.0) continue;
            const MorphTarget& target = deformation_.targets[t];
            for (std::size_t v = 0; v < target.positions.size(); ++v) {
                positions_[v] += weight * glm::dvec3(target.positions[v]);
            }
            for (std::size_t v = 0; v < target.normals.size(); ++v) {
                normals_[v] += weight * glm::dvec3(target.normals[v]);
            }
        }
    }

    void skin() {
        for (std::size_t v = 0; v < positions_.size(); ++v) {
            const std::uint32_t begin = deformation_.first_influence[v];
            const std::uint32_t end = deformation_.first_influence[v + 1];
            glm::dmat4 matrix(0.0);
            for (std::uint32_t i = begin; i < end; ++i) {
                const Influence& influence = deformation_.influences[i];
                matrix += inputs_.joints[influence.joint] * influence.weight;
            }
            positions_[v] = glm::dvec3(matrix * glm::dvec4(positions_[v], 1.0));
            normals_[v] = transformed_normal(matrix, normals_[v]);
        }
    }

    const Mesh& mesh_;
    const MeshDeformation& deformation_;
    const Inputs& inputs_;
    std::vector<glm::dvec3> positions_;
    std::vector<glm::dvec3> normals_;
};

class Deformer {
public:
    explicit Deformer(Scene& scene) : registry_(scene.registry) {}

    Status deform(Entity entity, const std::shared_ptr<const Mesh>& mesh) {
        auto inputs = inputs_of(entity, *mesh);
        if (!inputs) return forward_error(inputs);
        Deformed* known = registry_.try_get<Deformed>(entity);
        std::vector<double> flattened = inputs->flattened();
        if (known != nullptr && known->mesh == mesh && same_bits(known->inputs, flattened))
            return {};

        Deformed deformed;
        if (const auto vertex = Evaluation(*mesh, *inputs).store(deformed)) {
            return refuse(entity, fmt::format("its joints and weights move vertex {} of its mesh "
                                              "beyond what is finite",
                                              *vertex));
        }
        deformed.mesh = mesh;
        deformed.inputs = std::move(flattened);
        const bool is_same = known != nullptr && known->mesh == mesh &&
                             known->origin == deformed.origin &&
                             same_bits(known->positions, deformed.positions) &&
                             same_bits(known->normals, deformed.normals);
        deformed.revision = is_same ? known->revision : next_revision();
        registry_.emplace<Deformed>(entity, std::move(deformed));
        return {};
    }

private:
    [[nodiscard]] tl::unexpected<Error> refuse(Entity entity, const std::string& what) const {
        const auto* name = registry_.try_get<Name>(entity);
        return fail(ErrorCode::InvalidInput,
                    fmt::format("Node \"{}\": {}.", name == nullptr ? "" : name->value, what));
    }

    Result<Inputs> inputs_of(Entity entity, const Mesh& mesh) {
        const MeshDeformation& deformation = *mesh.deformation;
        Inputs inputs;
        const auto* weights = registry_.try_get<MorphWeights>(entity);
        inputs.weights = weights == nullptr ? deformation.default_weights : weights->values;
        if (inputs.weights.size() != deformation.targets.size()) {
            return refuse(entity, fmt::format("it has {} weights, but its mesh has {} morph "
                                              "targets",
                                              inputs.weights.size(), deformation.targets.size()));
        }
        const auto* skin = registry_.try_get<Skin>(entity);
        if (skin == nullptr || !deformation.is_skinned()) return inputs;
        if (skin->joints.size() < deformation.joint_count) {
            return refuse(entity, fmt::format("its mesh uses joint {}, but the skin has only {}",
                                              deformation.joint_count - 1, skin->joints.size()));
        }
        if (skin->inverse_bind_matrices->size() != skin->joints.size()) {
            return refuse(entity,
                          fmt::format("its skin has {} inverse bind matrices, but {} "
                                      "joints",
                                      skin->inverse_bind_matrices->size(), skin->joints.size()));
        }
        const auto space = posed_parent(registry_, entity);
        PosesBelow& poses =
            poses_.try_emplace(space ? space->key() : ~std::uint64_t{0}, registry_, space)
                .first->second;
        for (std::size_t i = 0; i < skin->joints.size(); ++i) {
            if (!registry_.has<LocalTransform>(skin->joints[i])) {
                return refuse(entity, fmt::format("joint {} of its skin is gone", i));
            }
            inputs.joints.push_back(poses.of(skin->joints[i]) * (*skin->inverse_bind_matrices)[i]);
        }
        return inputs;
    }

    Registry& registry_;
    std::map<std::uint64_t, PosesBelow> poses_;
};

}  // namespace

Status deform(Scene& scene) {
    Deformer deformer(scene);
    Status status;
    scene.registry.each<MeshInstance>([&](Entity entity, const MeshInstance& instance) {
        if (instance.mesh == nullptr || instance.mesh->deformation == nullptr) return;
        if (!scene.registry.has<Skin>(entity) && !scene.registry.has<MorphWeights>(entity)) return;
        const Status done = deformer.deform(entity, instance.mesh);
        if (!done && status) status = done;
    });
    return status;
}

}  // namespace gnomon::scene
