// SPDX-License-Identifier: MIT
#include "internal/quad_pair.hpp"

namespace gnomon::shadows::internal {

std::optional<QuadMargin> cast_by_quads(const ShadowMesh& mesh, LightLocal light,
                                        NearCaps near_caps, QuadFacing facing, Facing& scratch) {
    if (mesh.is_deformed() || !fits_edge_quads(mesh)) return std::nullopt;
    const std::optional<double> margin = one_sided_margin(mesh, light);
    if (!margin) return std::nullopt;
    QuadMargin found{{.facing = facing, .near_caps = near_caps, .light = light}, *margin};
    if (facing == QuadFacing::Uploaded) {
        classify_faces(mesh, light, scratch, near_caps);
        found.casting.bits = std::make_shared<const FaceBits>(face_bits(scratch.weights));
        found.margin = scratch.margin;
    }
    return found;
}

std::shared_ptr<const Volume> volume_of_quads() {
    static const auto empty = std::make_shared<const Volume>();
    return empty;
}

Volume casting_faces(const ShadowMesh& mesh, const QuadCasting& casting) {
    const auto faces = mesh.faces();
    Volume volume;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (casting.bits != nullptr && !casts(*casting.bits, f)) continue;
        for (const std::uint32_t v : faces[f]) volume.indices.push_back(2 * v);
    }
    volume.near_cap.triples = {0, static_cast<std::uint32_t>(volume.indices.size())};
    volume.near_cap.faces = volume.near_cap.triples.count / 3;
    return volume;
}

}  // namespace gnomon::shadows::internal
