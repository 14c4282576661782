// SPDX-License-Identifier: MIT
#include "stats_json.hpp"

#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace {

using Json = nlohmann::ordered_json;

// Null where nothing was counted.
Json sum_of(const std::optional<std::vector<shadow_pass::LightFill>>& fill,
            std::uint64_t shadow_pass::LightFill::*member) {
    if (!fill) return nullptr;
    std::uint64_t sum = 0;
    for (const shadow_pass::LightFill& light : *fill) sum += light.*member;
    return sum;
}

}  // namespace

std::string to_json(const RunRecord& run) {
    Json frames = Json::array();
    for (const FrameRecord& frame : run.frames) {
        const shadows::FrameStats& s = frame.shadows;
        Json choices = Json::object();
        for (std::size_t i = 0; i < s.choices.size(); ++i) {
            if (s.choices[i] > 0)
                choices[std::string(to_string(static_cast<shadows::Choice>(i)))] = s.choices[i];
        }
        Json reasons = Json::object();
        for (std::size_t i = 0; i < s.reasons.size(); ++i) {
            if (s.reasons[i] > 0)
                reasons[std::string(to_string(static_cast<shadows::Reason>(i)))] = s.reasons[i];
        }
        frames.push_back(
            {{"frame_ms", frame.frame_ms},
             {"detect_ms", s.detect_ms},
             {"build_ms", s.build_ms},
             {"record_ms", frame.record_ms},
             {"submit_ms", frame.submit_ms},
             {"pairs", s.pairs},
             {"pairs_culled", s.pairs_culled},
             {"pairs_hidden", s.pairs_hidden},
             {"pairs_in_umbra", s.pairs_in_umbra},
             {"pairs_clamped", s.pairs_clamped},
             {"pairs_in_slabs", s.pairs_in_slabs},
             {"pairs_redetected", s.pairs_redetected},
             {"pairs_reused", s.pairs_reused},
             {"zpass_pairs", s.zpass_pairs},
             {"zfail_pairs", s.zfail_pairs},
             {"silhouette_edges", s.silhouette_edges},
             {"quad_pairs", s.quad_pairs},
             {"faces_tested", s.detection.faces_tested},
             {"stencil_batches", s.stencil_batches},
             {"split_lights", s.split_lights},
             {"double_tests", s.detection.double_tests},
             {"exact_tests", s.detection.exact_tests},
             {"upload_bytes", frame.upload_bytes},
             {"draw_calls", frame.draw_calls},
             {"depth_bounded_draws", frame.depth_bounded_draws},
             {"stencil_fragments", sum_of(frame.fill, &shadow_pass::LightFill::rasterised)},
             {"stencil_fragments_counted", sum_of(frame.fill, &shadow_pass::LightFill::counted)},
             {"silhouette", std::string(s.silhouette)},
             {"silhouette_choices", choices},
             {"reasons", reasons}});
    }
    const Json json{{"backend", run.caps.backend},
                    {"adapter", run.caps.adapter},
                    {"stencil_path", run.caps.stencil_path},
                    {"width", run.width},
                    {"height", run.height},
                    {"samples", run.samples},
                    {"casters", run.frames.empty() ? 0 : run.frames.back().shadows.casters},
                    {"lights", run.frames.empty() ? 0 : run.frames.back().shadows.lights},
                    {"triangles", run.triangles},
                    {"frames", frames}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::cli
