// SPDX-License-Identifier: MIT
#include "tests/hard_cases/hard_case.hpp"

#include <utility>

namespace gnomon::test {

void add_by_both(std::vector<HardCase>& cases, HardCase hard_case) {
    cases.push_back(hard_case);
    hard_case.name += "_by_depth_fail";
    hard_case.options.technique = shadows::Technique::DepthFail;
    cases.push_back(std::move(hard_case));
}

const std::vector<HardCase>& hard_cases() {
    static const std::vector<HardCase> all = [] {
        std::vector<HardCase> cases;
        for (auto family : {topology_cases, dirty_mesh_cases, adjoining_cases, caster_cases,
                            light_cases, camera_cases, pose_cases, layer_cases}) {
            auto more = family();
            cases.insert(cases.end(), more.begin(), more.end());
        }
        return cases;
    }();
    return all;
}

}  // namespace gnomon::test
