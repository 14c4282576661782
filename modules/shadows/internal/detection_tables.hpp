// SPDX-License-Identifier: MIT
//
// What detectors search in, made once a mesh.
#pragma once

#include <gnomon/shadows/jobs.hpp>

#include "dual_boxes.hpp"

namespace gnomon::shadows::internal {

struct DetectionTables {
    DualBoxes faces;  ///< blocks of 16 faces
    DualBoxes edges;  ///< blocks of 16 regular edges
};

[[nodiscard]] DetectionTables make_tables(const ShadowMesh& mesh, const Jobs& jobs = {});

}  // namespace gnomon::shadows::internal
