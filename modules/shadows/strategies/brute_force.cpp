// SPDX-License-Identifier: MIT
//
// The reference: every face is classified, every edge summed up.
#include "internal/strategies.hpp"

namespace gnomon::shadows::internal {

namespace {

class BruteForce final : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override {
        classify_faces(mesh, light, facing_, near_caps, FacingFilter::Scalar);
        pack_weights(facing_.weights, found_.casting);
        find_silhouette(mesh, facing_.weights, found_.silhouette);
        found_.solid_averted = facing_.solid_averted;
        found_.margin = facing_.margin;
        found_.stats = {.faces_tested = mesh.faces().size(),
                        .edges_tested = mesh.edges().size(),
                        .double_tests = facing_.stats.double_tests,
                        .exact_tests = facing_.stats.exact_tests,
                        .bytes_touched = mesh.faces().size() * (5 * sizeof(float) + 2) +
                                         mesh.edges().size() * sizeof(Edge) +
                                         mesh.uses().size() * (sizeof(FaceUse) + 1)};
        return found_;
    }

    [[nodiscard]] std::size_t memory_bytes() const override {
        return sizeof *this + facing_.weights.capacity() + facing_.solid_averted.capacity() +
               memory_of(found_);
    }

private:
    Facing facing_;
    Detection found_;
};

}  // namespace

std::unique_ptr<SilhouetteDetector> brute_force_detector() {
    return std::make_unique<BruteForce>();
}

}  // namespace gnomon::shadows::internal
