// SPDX-License-Identifier: MIT
//
// Exact temporal coherence (strategies/certificates.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gnomon/shadows/detector.hpp>

#include "deadlines.hpp"
#include "side_detection.hpp"
#include "silhouette_set.hpp"

namespace gnomon::shadows::internal {

/// far() and forget() are for who chooses between this and other ways.
class Certificates final : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override;
    [[nodiscard]] std::size_t memory_bytes() const override;
    /// A light that went further since the last search has most certificates void, so that another
    /// search costs less than to renew them, as far as can be told. 0 before the first call.
    [[nodiscard]] double far() const { return far_; }

    /// Starts anew with the next call. far() stays.
    void forget() { mesh_ = 0; }

private:
    void search(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps);
    void renew(const ShadowMesh& mesh);
    bool renew_castings(const ShadowMesh& mesh);
    void find_whole_silhouette(const ShadowMesh& mesh, const FilterLight& light);

    std::uint64_t mesh_ = 0;  // 0: nothing is known
    NearCaps near_caps_ = NearCaps::Facing;
    LightLocal light_;     // where the light was when something was due last
    double way_ = 0.0;     // that it had come
    Deadlines deadlines_;  // by block of faces
    double castings_deadline_ = 0.0;
    Sides sides_;
    Detection found_;
    SilhouetteSet silhouette_{found_.silhouette};
    std::vector<std::uint32_t> flipped_;
    std::vector<std::uint32_t> blocks_;  // searched, or due
    // Beyond this way a search costs less than renewing what is due, as far as can be told.
    double far_ = 0.0;
};

}  // namespace gnomon::shadows::internal
