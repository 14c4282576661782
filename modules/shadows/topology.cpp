// SPDX-License-Identifier: MIT
#include <gnomon/shadows/topology.hpp>

namespace gnomon::shadows {

std::int32_t edge_balance(std::span<const FaceUse> uses) {
    std::int32_t sum = 0;
    for (const FaceUse& use : uses) sum += use.sign();
    return sum;
}

EdgeKind edge_kind(std::span<const FaceUse> uses) {
    if (uses.size() == 1) return EdgeKind::Boundary;
    if (uses.size() > 2) return EdgeKind::NonManifold;
    return edge_balance(uses) == 0 ? EdgeKind::Regular : EdgeKind::Inconsistent;
}

CasterKind caster_kind(const Component& component) {
    if (component.degenerate_faces == component.faces) return CasterKind::Nothing;
    if (!component.closed) return CasterKind::TwoSided;
    return component.inside_out ? CasterKind::InsideOut : CasterKind::OneSided;
}

}  // namespace gnomon::shadows
