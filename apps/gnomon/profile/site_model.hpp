// SPDX-License-Identifier: MIT
//
// SiteModel: the casters of a model, posed in the plan's coordinates.
#pragma once

#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#include "profile/profile_options.hpp"

namespace gnomon::cli {

struct SiteModel {
    std::vector<shadows::Caster> casters;
    glm::dvec3 min_plan{0.0};  ///< of all their vertices
    glm::dvec3 max_plan{0.0};
    std::string hash;  ///< of all vertices, faces and poses
    std::vector<std::string> notes;
};

/// Loads a model as gnomon render does (scene::load_scene()); every node with a mesh casts, or
/// those that `glob` matches: nodes by name, or components of one mesh (faces connected through
/// edges) by NAME#K, as gnomon inspect numbers them from 0. Fails as load_scene() does, and with
/// ErrorCode::InvalidInput, in the name of `option`, where nothing matches; not so where
/// `may_be_empty`.
[[nodiscard]] Result<SiteModel> load_site(const ProfileOptions& options, const std::string& model,
                                          const std::optional<std::string>& glob,
                                          const char* option, bool may_be_empty = false);

}  // namespace gnomon::cli
