// SPDX-License-Identifier: MIT
#include "literature.hpp"

#include <algorithm>
#include <array>

#include <gnomon/shadows/volume.hpp>

namespace gnomon::bench {

namespace {

class NoSilhouette final : public shadows::SilhouetteDetector {
public:
    const shadows::Detection& detect(const shadows::ShadowMesh& mesh, shadows::LightLocal light,
                                     shadows::NearCaps near_caps) override {
        shadows::classify_faces(mesh, light, facing_, near_caps, shadows::FacingFilter::Scalar);
        shadows::pack_weights(facing_.weights, found_.casting);
        found_.silhouette.clear();
        for (std::size_t f = 0; f < facing_.weights.size(); ++f) {
            const int weight = facing_.weights[f];
            if (weight == 0) continue;
            const auto& face = mesh.faces()[f];
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = face[i];
                const std::uint32_t b = face[(i + 1) % 3];
                found_.silhouette.push_back(weight > 0 ? shadows::SilhouetteEdge{a, b, 1}
                                                       : shadows::SilhouetteEdge{b, a, 1});
            }
        }
        found_.solid_averted = facing_.solid_averted;
        found_.stats = {.faces_tested = mesh.faces().size(),
                        .edges_tested = found_.silhouette.size(),
                        .double_tests = facing_.stats.double_tests,
                        .exact_tests = facing_.stats.exact_tests,
                        .bytes_touched = mesh.faces().size() * (5 * sizeof(float) + 14)};
        return found_;
    }
    [[nodiscard]] std::size_t memory_bytes() const override {
        return sizeof *this + facing_.weights.capacity() +
               2 * found_.casting.plus.capacity() * sizeof(std::uint64_t) +
               found_.silhouette.capacity() * sizeof(shadows::SilhouetteEdge);
    }

private:
    shadows::Facing facing_;
    shadows::Detection found_;
};

class WithVolume final : public shadows::SilhouetteDetector {
public:
    explicit WithVolume(std::unique_ptr<shadows::SilhouetteDetector> detector)
        : detector_(std::move(detector)) {}

    const shadows::Detection& detect(const shadows::ShadowMesh& mesh, shadows::LightLocal light,
                                     shadows::NearCaps near_caps) override {
        const shadows::Detection& found = detector_->detect(mesh, light, near_caps);
        weights_.resize(mesh.faces().size());
        shadows::runs_of(found.casting, runs_);
        shadows::weights_of(runs_, weights_);
        shadows::build_volume(mesh, weights_, found.silhouette, light.is_directional(),
                              shadows::FarVertices::AtInfinity, volume_, found.solid_averted);
        return found;
    }
    [[nodiscard]] std::size_t memory_bytes() const override {
        return detector_->memory_bytes() + volume_.indices.capacity() * sizeof(std::uint32_t);
    }

private:
    std::unique_ptr<shadows::SilhouetteDetector> detector_;
    std::vector<shadows::FaceRun> runs_;
    std::vector<std::int8_t> weights_;
    shadows::Volume volume_;
};

}  // namespace

bool is_of_the_literature(std::string_view strategy) {
    constexpr std::array<std::string_view, 5> names{"edge_stack", "edge_stack_naive", "vnv",
                                                    "edge_list", "hextree"};
    return std::ranges::find(names, strategy) != names.end();
}

bool is_memoryless(const shadows::SilhouetteStrategy& strategy) {
    return !strategy.keeps_state || is_of_the_literature(strategy.name);
}

std::vector<Contestant> with_volumes() {
    std::vector<Contestant> result;
    for (const shadows::SilhouetteStrategy& strategy : shadows::silhouette_strategies()) {
        if (strategy.quads != shadows::QuadFacing::None) continue;  // another one's detector
        result.push_back(
            {std::string(strategy.name),
             [create = strategy.create] { return std::make_unique<WithVolume>(create()); }, true,
             is_memoryless(strategy)});
    }
    return result;
}

Contestant without_silhouette() {
    return {"none", [] { return std::make_unique<WithVolume>(std::make_unique<NoSilhouette>()); },
            false, true};
}

}  // namespace gnomon::bench
