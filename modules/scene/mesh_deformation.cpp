// SPDX-License-Identifier: MIT
#include <gnomon/scene/mesh_deformation.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <fmt/format.h>

#include <gnomon/scene/mesh.hpp>

namespace gnomon::scene {
namespace {

bool all_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Status check_targets(const MeshDeformationSource& source, std::size_t vertices) {
    for (std::size_t t = 0; t < source.targets.size(); ++t) {
        const MorphTarget& target = source.targets[t];
        for (const auto* deltas : {&target.positions, &target.normals}) {
            if (!deltas->empty() && deltas->size() != vertices) {
                return fail(ErrorCode::InvalidInput,
                            fmt::format("Morph target {} has {} deltas, but must have one for each "
                                        "of {} vertices.",
                                        t, deltas->size(), vertices));
            }
            const auto bad = std::find_if_not(deltas->begin(), deltas->end(), all_finite);
            if (bad == deltas->end()) continue;
            return fail(ErrorCode::InvalidInput,
                        fmt::format("Delta {} of morph target {} is ({}, {}, {}), but must be "
                                    "finite.",
                                    bad - deltas->begin(), t, bad->x, bad->y, bad->z));
        }
    }
    if (!source.default_weights.empty() && source.default_weights.size() != source.targets.size()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("There are {} default weights, but {} morph targets.",
                                source.default_weights.size(), source.targets.size()));
    }
    for (std::size_t t = 0; t < source.default_weights.size(); ++t) {
        if (std::isfinite(source.default_weights[t])) continue;
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The default weight of morph target {} is {}, but must be finite.",
                                t, source.default_weights[t]));
    }
    return {};
}

Status check_influences(const MeshDeformationSource& source, std::size_t vertices) {
    const std::size_t per_vertex = source.influences_per_vertex;
    if (source.joints.size() != per_vertex * vertices ||
        source.weights.size() != per_vertex * vertices) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("There are {} joints and {} weights, but must be {} of both for "
                                "each of {} vertices.",
                                source.joints.size(), source.weights.size(), per_vertex, vertices));
    }
    for (std::size_t i = 0; i < source.weights.size(); ++i) {
        const float weight = source.weights[i];
        if (std::isfinite(weight) && weight >= 0.0F) continue;
        return fail(ErrorCode::InvalidInput,
                    fmt::format("Weight {} of vertex {} is {}, but must be finite and not "
                                "negative.",
                                i % per_vertex, i / per_vertex, weight));
    }
    return {};
}

/// Appends the one form of a vertex's influences.
void add_influences(MeshDeformation& result, const MeshDeformationSource& source,
                    std::size_t vertex) {
    const auto first = static_cast<std::ptrdiff_t>(result.influences.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < source.influences_per_vertex; ++k) {
        const std::size_t i = vertex * source.influences_per_vertex + k;
        const double weight = source.weights[i];
        if (weight == 0.0) continue;
        const auto begin = result.influences.begin() + first;
        const auto at = std::lower_bound(
            begin, result.influences.end(), source.joints[i],
            [](const Influence& known, std::uint32_t joint) { return known.joint < joint; });
        if (at != result.influences.end() && at->joint == source.joints[i]) {
            at->weight += weight;
        } else {
            result.influences.insert(at, {source.joints[i], weight});
        }
    }
    // Added up by joint: two vertices that name the same joints in another order are still equal.
    for (auto i = result.influences.begin() + first; i != result.influences.end(); ++i) {
        sum += i->weight;
    }
    // Weights are rounded in files and often miss 1 by their last digits.
    for (auto i = result.influences.begin() + first; i != result.influences.end(); ++i) {
        i->weight /= sum;
    }
    if (static_cast<std::ptrdiff_t>(result.influences.size()) == first) {
        result.influences.push_back({0, 1.0});
    }
    result.joint_count = std::max(result.joint_count, result.influences.back().joint + 1);
}

class Identities {
public:
    Identities(const Mesh& mesh, const MeshDeformation& deformation)
        : mesh_(mesh), deformation_(deformation) {}

    std::vector<std::uint32_t> number() const {
        constexpr auto none = std::numeric_limits<std::uint32_t>::max();
        const std::size_t count = mesh_.positions.size();
        std::vector<std::uint32_t> identities(count);
        std::vector<std::uint32_t> next(count, none);  // the next other vertex of the same hash
        std::unordered_map<std::uint64_t, std::uint32_t> first;
        first.reserve(count);
        for (std::uint32_t v = 0; v < count; ++v) {
            const auto [found, is_new] = first.try_emplace(hash(v), v);
            std::uint32_t same = found->second;
            while (!is_new && !are_equal(same, v)) {
                if (next[same] == none) next[same] = v;
                same = next[same];
            }
            identities[v] = same;
        }
        return identities;
    }

private:
    [[nodiscard]] std::span<const Influence> influences(std::uint32_t v) const {
        if (!deformation_.is_skinned()) return {};
        const std::uint32_t begin = deformation_.first_influence[v];
        return std::span(deformation_.influences)
            .subspan(begin, deformation_.first_influence[v + 1] - begin);
    }
    [[nodiscard]] bool are_equal(std::uint32_t a, std::uint32_t b) const {
        const auto of_a = influences(a);
        const auto of_b = influences(b);
        return mesh_.positions[a] == mesh_.positions[b] &&
               std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) &&
               std::all_of(deformation_.targets.begin(), deformation_.targets.end(),
                           [&](const MorphTarget& target) {
                               return target.positions.empty() ||
                                      target.positions[a] == target.positions[b];
                           });
    }
    static void mix(std::uint64_t& hash, std::uint64_t word) {
        hash = (hash ^ word) * 0xFF51AFD7ED558CCDULL;
        hash ^= hash >> 29U;
    }
    static void mix(std::uint64_t& hash, const glm::vec3& v) {
        for (int axis = 0; axis < 3; ++axis) {
            mix(hash, std::bit_cast<std::uint32_t>(v[axis] + 0.0F));  // the two zeros are equal
        }
    }
    [[nodiscard]] std::uint64_t hash(std::uint32_t v) const {
        std::uint64_t hash = 0x9E3779B97F4A7C15ULL;
        mix(hash, mesh_.positions[v]);
        for (const Influence& influence : influences(v)) {
            mix(hash, influence.joint);
            mix(hash, std::bit_cast<std::uint64_t>(influence.weight));
        }
        for (const MorphTarget& target : deformation_.targets) {
            if (!target.positions.empty()) mix(hash, target.positions[v]);
        }
        return hash;
    }

    const Mesh& mesh_;
    const MeshDeformation& deformation_;
};

}  // namespace

Result<std::shared_ptr<const MeshDeformation>> make_mesh_deformation(const Mesh& mesh,
                                                                     MeshDeformationSource source) {
    const std::size_t vertices = mesh.positions.size();
    if (const Status good = check_influences(source, vertices); !good) return forward_error(good);
    if (const Status good = check_targets(source, vertices); !good) return forward_error(good);

    auto result = std::make_shared<MeshDeformation>();
    if (source.influences_per_vertex > 0) {
        result->first_influence.reserve(vertices + 1);
        for (std::size_t v = 0; v < vertices; ++v) {
            result->first_influence.push_back(
                static_cast<std::uint32_t>(result->influences.size()));
            add_influences(*result, source, v);
        }
        result->first_influence.push_back(static_cast<std::uint32_t>(result->influences.size()));
    }
    result->targets = std::move(source.targets);
    result->default_weights = std::move(source.default_weights);
    result->default_weights.resize(result->targets.size(), 0.0);
    result->flat = std::move(source.flat);
    result->identities = Identities(mesh, *result).number();
    return result;
}

}  // namespace gnomon::scene
