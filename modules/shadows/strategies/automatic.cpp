// SPDX-License-Identifier: MIT
//
// The choice between simd, dual_bvh and certificates: by the mesh's size, by what searches found of
// it so far, and by how far the light went.
#include <memory>
#include <optional>

#include "internal/certificates.hpp"
#include "internal/displacement.hpp"
#include "internal/strategies.hpp"

namespace gnomon::shadows::internal {

namespace {

// Below, all planes and edges cost less than the way through two hierarchies (docs/performance.md).
constexpr std::size_t few_faces = 6000;
// A search that looks at a larger part of the edges costs more than looking at all of them in turn.
constexpr double large_part = 0.4;
// A silhouette may become small again: after so many times simd was taken, search once.
constexpr std::uint32_t patience = 64;

class Automatic final : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override;

    [[nodiscard]] Choice choice() const override { return choice_; }

    [[nodiscard]] std::size_t memory_bytes() const override {
        std::size_t bytes = sizeof *this;
        if (simd_ != nullptr) bytes += simd_->memory_bytes();
        if (search_ != nullptr) bytes += search_->memory_bytes();
        if (certificates_ != nullptr) bytes += certificates_->memory_bytes();
        return bytes;
    }

private:
    [[nodiscard]] Choice choose(const ShadowMesh& mesh, LightLocal light) const;
    [[nodiscard]] bool is_small_step(const ShadowMesh& mesh, LightLocal light) const;

    std::unique_ptr<SilhouetteDetector> simd_;
    std::unique_ptr<SilhouetteDetector> search_;
    std::unique_ptr<Certificates> certificates_;
    Choice choice_ = Choice::Jump;
    std::uint64_t mesh_ = 0;
    std::optional<LightLocal> last_;
    std::uint32_t since_search_ = 0;
    double searched_part_ = 0.0;  // of the edges, by the last search
};

bool Automatic::is_small_step(const ShadowMesh& mesh, LightLocal light) const {
    if (!last_ || last_->is_directional() != light.is_directional()) return false;
    const double step = displacement(*last_, light);
    if (certificates_ != nullptr) return step < certificates_->far();
    // How far is far is not known before there were certificates once. They are not worth a try
    // where the light goes some three degrees round the mesh at once.
    constexpr double far = 0.05;
    const double distance =
        light.is_directional()
            ? 1.0
            : glm::length(glm::dvec3(light.position) - glm::dvec3(mesh.planes().origin));
    return step < far * distance;
}

Choice Automatic::choose(const ShadowMesh& mesh, LightLocal light) const {
    if (!mesh.is_deformed() && is_small_step(mesh, light)) return Choice::SmallStep;
    const Choice choice = choose_for_jump(mesh);
    const bool large = searched_part_ > large_part && since_search_ < patience;
    return choice == Choice::Jump && large ? Choice::LargeSilhouette : choice;
}

const Detection& Automatic::detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) {
    if (mesh_ != mesh.id()) {
        mesh_ = mesh.id();
        last_.reset();
        certificates_.reset();
        searched_part_ = 0.0;
    }
    choice_ = choose(mesh, light);
    last_ = light;
    if (choice_ == Choice::SmallStep) {
        if (certificates_ == nullptr) certificates_ = std::make_unique<Certificates>();
        return certificates_->detect(mesh, light, near_caps);
    }
    // What they know is of another light, and "unchanged" would be since then.
    if (certificates_ != nullptr) certificates_->forget();
    if (choice_ != Choice::Jump) {
        ++since_search_;
        if (simd_ == nullptr) simd_ = simd_detector();
        return simd_->detect(mesh, light, near_caps);
    }
    if (search_ == nullptr) search_ = dual_bvh_detector();
    const Detection& found = search_->detect(mesh, light, near_caps);
    since_search_ = 0;
    searched_part_ = static_cast<double>(found.stats.edges_tested) /
                     static_cast<double>(mesh.edges().size() + 1);
    return found;
}

}  // namespace

Choice choose_for_jump(const ShadowMesh& mesh) {
    if (mesh.is_deformed()) return Choice::Deforming;
    return mesh.faces().size() < few_faces ? Choice::FewFaces : Choice::Jump;
}

std::unique_ptr<SilhouetteDetector> automatic_detector() { return std::make_unique<Automatic>(); }

}  // namespace gnomon::shadows::internal
