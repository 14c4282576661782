// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <utility>

#include <gnomon/core/expects.hpp>
#include <gnomon/shadows/layer_bound.hpp>

#include "internal/disjoint_sets.hpp"
#include "internal/layers.hpp"

namespace gnomon::shadows {

namespace {

// What a volume was built from.
struct Source {
    std::vector<std::int8_t> weights;
    std::vector<std::uint8_t> solid_averted;  // by component
};

// Triples are in the mesh's order, so one walk along both finds their faces; where neighbouring
// faces are equal any of them may have the weight.
Source source_of(const ShadowMesh& mesh, const Volume& volume) {
    const auto faces = mesh.faces();
    Source source{std::vector<std::int8_t>(faces.size(), 0),
                  std::vector<std::uint8_t>(mesh.components().size(), 0)};
    const auto add = [&](const CapList& list, int weight, const auto& visit) {
        std::size_t f = 0;
        for (std::uint32_t i = 0; i < list.triples.count; i += 3) {
            const std::uint32_t* triple = &volume.indices[list.triples.first + i];
            const std::array cap{triple[0] / 2, triple[1] / 2, triple[2] / 2};
            while (faces[f] != cap) ++f;
            source.weights[f] = static_cast<std::int8_t>(source.weights[f] + weight);
            visit(f);
        }
        for_each_face_of_ranges(
            mesh, std::span(volume.ranges).subspan(list.ranges.first, list.ranges.count),
            std::span(volume.indices).subspan(list.undone.first, list.undone.count),
            [&](std::uint32_t face) {
                source.weights[face] = static_cast<std::int8_t>(source.weights[face] + weight);
                visit(face);
            });
    };
    add(volume.near_cap, 1, [](std::size_t) {});
    add(volume.near_cap_flipped, -1, [](std::size_t) {});
    add(volume.near_cap_averted, -1,
        [&](std::size_t f) { source.solid_averted[mesh.face_components()[f]] = 1; });
    return source;
}

// One unit of a face's weight.
struct CastingFace {
    std::uint32_t patch = 0;
    double distance = 0.0;  // from the light, or along its way
    std::uint32_t face = 0;
};

class Splitter {
public:
    Splitter(const ShadowMesh& mesh, const Volume& volume, const LayerSpace& space,
             std::uint32_t limit)
        : mesh_(mesh),
          space_(space),
          options_(volume.made_with),
          limit_(limit),
          source_(source_of(mesh, volume)),
          weights_(source_.weights),
          part_weights_(weights_.size(), 0) {
        order_faces();
    }

    std::vector<LayerPart> run() {
        if (!faces_.empty()) split(0, faces_.size());
        return std::move(parts_);
    }

private:
    void order_faces();
    void split(std::size_t begin, std::size_t end);

    const ShadowMesh& mesh_;
    const LayerSpace& space_;
    VolumeOptions options_;
    std::uint32_t limit_;
    Source source_;
    std::span<const std::int8_t> weights_;
    std::vector<std::int8_t> part_weights_;
    std::vector<FaceRun> part_runs_;
    std::vector<CastingFace> faces_;
    std::vector<SilhouetteEdge> boundary_;
    std::vector<std::uint32_t> caps_;
    std::vector<LayerPart> parts_;
};

void Splitter::order_faces() {
    internal::DisjointSets sets(weights_.size());
    const auto uses = mesh_.uses();
    for (const Edge& edge : mesh_.edges()) {
        std::int32_t sum = 0;
        for (std::uint32_t i = edge.first_use; i < edge.first_use + edge.use_count; ++i) {
            sum += uses[i].sign() * weights_[uses[i].face];
        }
        if (sum != 0) continue;
        const FaceUse* first = nullptr;
        for (std::uint32_t i = edge.first_use; i < edge.first_use + edge.use_count; ++i) {
            if (weights_[uses[i].face] == 0) continue;
            if (first != nullptr) sets.join(first->face, uses[i].face);
            first = &uses[i];
        }
    }
    const glm::dvec3 light(space_.light);
    for (std::uint32_t f = 0; f < weights_.size(); ++f) {
        if (weights_[f] == 0) continue;
        glm::dvec3 center(0.0);
        for (const std::uint32_t v : mesh_.faces()[f]) {
            center += glm::dvec3(mesh_.positions()[v]) / 3.0;
        }
        center = glm::dvec3(space_.space_from_local * glm::dvec4(center, 1.0));
        const double distance =
            space_.light.w == 0.0 ? -glm::dot(center, light) : glm::length(center - light);
        for (int i = 0; i < std::abs(weights_[f]); ++i) {
            faces_.push_back({sets.find(f), distance, f});
        }
    }
    std::sort(faces_.begin(), faces_.end(), [](const CastingFace& a, const CastingFace& b) {
        return std::tie(a.patch, a.distance, a.face) < std::tie(b.patch, b.distance, b.face);
    });
}

void Splitter::split(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        std::int8_t& weight = part_weights_[faces_[i].face];
        weight = static_cast<std::int8_t>(weight + (weights_[faces_[i].face] > 0 ? 1 : -1));
    }
    find_silhouette(mesh_, part_weights_, boundary_);
    caps_.clear();
    for (std::size_t i = begin; i < end; ++i) {
        for (const std::uint32_t v : mesh_.faces()[faces_[i].face]) caps_.push_back(2 * v);
    }
    const std::uint32_t layers =
        internal::bound_layers(mesh_, {.triples = caps_}, boundary_, space_);
    if (layers <= limit_) {
        LayerPart& part = parts_.emplace_back();
        part.layers = layers;
        runs_of(part_weights_, part_runs_);
        build_volume(mesh_, part_runs_, boundary_, options_, part.volume, source_.solid_averted);
    }
    for (std::size_t i = begin; i < end; ++i) part_weights_[faces_[i].face] = 0;
    if (layers <= limit_) return;
    // In so many parts as are needed at least, and so that no part is left with a few layers.
    const std::size_t parts = (layers + limit_ - 1) / limit_;
    std::size_t middle = begin + std::max<std::size_t>(1, (end - begin) * (parts / 2) / parts);
    const auto is_cut = [&](std::size_t i) { return faces_[i - 1].patch != faces_[i].patch; };
    std::size_t before = middle;
    while (before > begin && !is_cut(before)) --before;
    std::size_t after = middle;
    while (after < end && !is_cut(after)) ++after;
    if (before > begin && (after == end || middle - before <= after - middle)) {
        middle = before;
    } else if (after < end) {
        middle = after;
    }
    split(begin, middle);
    split(middle, end);
}

}  // namespace

std::vector<LayerPart> split_volume(const ShadowMesh& mesh, const Volume& volume,
                                    const LayerSpace& space, std::uint32_t limit) {
    GNOMON_EXPECTS(limit >= 1);
    return Splitter(mesh, volume, space, limit).run();
}

}  // namespace gnomon::shadows
