// SPDX-License-Identifier: MIT
//
// The table of what is compared.
#include <fmt/format.h>

#include "internal/baselines.hpp"
#include "internal/technique.hpp"
#include "internal/volumes.hpp"

namespace gnomon::report::internal {

namespace {

constexpr const char* as_exact =
    "It is as exact; which of such variants is the fastest depends on the scene.";
constexpr const char* saves_nothing =
    "It is as exact; where shadows are few and small, the savings cost more than they save.";
constexpr const char* other_depth =
    "Whether its depth is fine enough depends on the scene and the near plane.";
constexpr const char* by_luck = "It is an approximation: right in these frames, not in all.";

class Table {
public:
    void volumes(std::string name, const char* family, std::string summary, const char* caveat,
                 const VolumeTechnique& how, bool quick = false) {
        const bool general = caveat == as_exact || caveat == saves_nothing || *caveat == '\0';
        entries.push_back({std::move(name), family, std::move(summary), caveat, quick, general,
                           [how](const Setup& setup) { return create_volumes(setup, how); }});
    }
    std::vector<Entry> entries;
};

void add_exact(Table& table) {
    using shadows::Technique;
    table.volumes("auto", "volumes", "Shadow volumes as gnomon draws them unless told otherwise.",
                  "", {}, true);
    table.volumes("depth-pass", "volumes",
                  "Counts volumes in front of surfaces for every caster, valid or not: wrong where "
                  "the near plane cuts a volume.",
                  "It is right only where no near plane cuts a shadow volume, as here.",
                  {.system = {.force_technique = Technique::DepthPass}}, true);
    table.volumes("depth-fail", "volumes",
                  "Counts volumes behind surfaces for every caster: always right, and needs caps.",
                  as_exact, {.system = {.force_technique = Technique::DepthFail}}, true);
    table.volumes("depth-fail, averted caps", "volumes",
                  "The same with near caps on the faces that are turned away from the light.",
                  as_exact,
                  {.system = {.force_technique = Technique::DepthFail},
                   .near_caps = shadows::NearCaps::Averted});
    table.volumes("depth-fail, fan caps", "volumes",
                  "The same with far caps as fans over the silhouette, where that is exact.",
                  as_exact,
                  {.system = {.force_technique = Technique::DepthFail,
                              .caps = {.far_cap = shadows::FarCap::Fan}}});
    table.volumes("depth-fail, plain caps", "volumes",
                  "The same with every cap triangle written out, as most text books do.", as_exact,
                  {.system = {.force_technique = Technique::DepthFail,
                              .caps = shadows::CapOptions::plain()}});
    table.volumes("no fill savings", "volumes", "Nothing is culled, clamped or cut to a scissor.",
                  saves_nothing, {.system = {.fill = shadows::FillOptions::none()}}, true);
    table.volumes("layers promised", "volumes",
                  "The scene promises fewer than 256 layers, so none are bounded.",
                  "It takes a promise about the scene, which auto does not ask for.",
                  {.system = {.layer_bound = shadows::LayerBound::Promised}});
    table.volumes("reversed-Z, D24S8", "projection", "24 bits of integer depth, reversed.",
                  other_depth, {.format = gpu::Format::Depth24UnormStencil8});
    table.volumes("epsilon, D32F_S8", "projection",
                  "The usual infinite matrix, depth running forward and held back by an epsilon.",
                  other_depth, {.projection = Projection::Epsilon});
    table.volumes("epsilon, D24S8", "projection", "The same with 24 bits of integer depth.",
                  other_depth,
                  {.projection = Projection::Epsilon, .format = gpu::Format::Depth24UnormStencil8});
    table.volumes(
        "epsilon, D24S8, near x100", "projection",
        "The same with a near plane 100 times as far out, as forward depth needs it: what "
        "is nearer is cut away.",
        other_depth,
        {.projection = Projection::Epsilon,
         .format = gpu::Format::Depth24UnormStencil8,
         .near_scale = 100.0});
    table.volumes("depth clamp, D32F_S8", "projection",
                  "A far plane, and volumes that are clamped to it.", other_depth,
                  {.projection = Projection::Clamped});
    table.volumes("depth clamp, D24S8", "projection", "The same with 24 bits of integer depth.",
                  other_depth,
                  {.projection = Projection::Clamped, .format = gpu::Format::Depth24UnormStencil8});
    for (const shadows::SilhouetteStrategy& strategy : shadows::silhouette_strategies()) {
        table.volumes(fmt::format("silhouette {}", strategy.name), "silhouettes",
                      fmt::format("{}.", strategy.summary), as_exact,
                      {.system = {.silhouette = strategy.name}});
    }
}

void add_approximate(Table& table) {
    for (const double degrees : {0.01, 0.1, 0.5, 1.0, 2.0, 5.0}) {
        table.volumes(fmt::format("tolerance {} deg", degrees), "approximate",
                      fmt::format("A silhouette is kept while its light turns by less than {} "
                                  "degrees.",
                                  degrees),
                      by_luck, {.system = {.stale = {.pose_tolerance_rad = glm::radians(degrees)}}},
                      degrees == 1.0);
    }
    for (const std::uint32_t every : {2U, 3U, 4U}) {
        table.volumes(
            fmt::format("silhouette every {} frames", every), "approximate",
            fmt::format("One in {} casters has a new silhouette each frame, in turn.", every),
            by_luck, {.system = {.stale = {.detect_every = every}}}, every == 2);
    }
    for (const double share : {1.0, 0.25}) {
        table.volumes(
            fmt::format("reach {}x", share), "approximate",
            fmt::format("Volumes end {} of the scene's diagonal behind their caster.", share),
            by_luck, {.projection = Projection::Clamped, .reach_share = share});
    }
    for (const bool inset : {false, true}) {
        for (const int percent : {50, 25, 10}) {
            table.volumes(
                fmt::format("proxies {} %{}", percent, inset ? ", inset" : ""), "approximate",
                inset ? fmt::format("The same with {} %, and drawn in by what simplifying may have "
                                    "moved, so that casters shadow themselves less.",
                                    percent)
                      : fmt::format("Shadows are cast by stand-ins with {} % of the triangles.",
                                    percent),
                by_luck, {.proxy_share = percent / 100.0, .proxy_inset = inset},
                percent == 25 && inset);
        }
    }
    for (const std::size_t lights : {2U, 1U}) {
        table.volumes(fmt::format("{} shadowed light{}", lights, lights == 1 ? "" : "s"),
                      "approximate",
                      fmt::format("Only the {} that matter{} most cast{} shadows.",
                                  lights == 1 ? "light" : "two lights", lights == 1 ? "s" : "",
                                  lights == 1 ? "s" : ""),
                      by_luck, {.most_lights = lights});
    }
}

void add_baselines(Table& table) {
    const struct {
        MapFilter filter;
        const char* name;
        const char* summary;
    } filters[] = {
        {MapFilter::Plain, "shadow map",
         "Depth as the light sees it, fitted to what the camera sees, with a constant bias."},
        {MapFilter::Sloped, "shadow map, sloped",
         "The same with a bias that grows with the surface's slope."},
        {MapFilter::Pcf, "shadow map, 3x3",
         "The same with nine texels asked, and the majority taken."}};
    for (const auto& f : filters) {
        for (const std::uint32_t size : {512U, 1024U, 2048U, 4096U}) {
            table.entries.push_back(
                {fmt::format("{} {}", f.name, size), "shadow maps", f.summary, by_luck,
                 f.filter == MapFilter::Pcf ? size == 1024
                                            : f.filter == MapFilter::Sloped && size < 4096,
                 false, [size, filter = f.filter](const Setup& setup) {
                     return create_shadow_map(setup, size, filter);
                 }});
        }
    }
    table.entries.push_back({"planar", "planar",
                             "Casters are flattened onto the largest plane; nothing else has "
                             "shadows.",
                             "It is right only where nothing but one plane is shadowed, as here.",
                             true, false, create_planar});
    table.entries.push_back({"ray casting", "rays",
                             "Two rays a pixel on the processor, by Embree; its search trees were "
                             "built before, and its masks stay in main memory.",
                             "Where a program on the processor draws, two rays a pixel may cost "
                             "less than filling volumes; its search trees were built before and "
                             "stand still, as they could not for what moves.",
                             true, false, create_rays});
}

}  // namespace

std::vector<Entry> all_techniques() {
    Table table;
    add_exact(table);
    add_approximate(table);
    add_baselines(table);
    return std::move(table.entries);
}

Result<FrameCost> draw_and_wait(gpu::Device& device, gpu::CommandEncoder& encoder,
                                Clock::time_point start, std::uint64_t uploaded) {
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    FrameCost cost;
    cost.record_ms = milliseconds_since(start);
    if (const Status done = device.submit(*commands); !done) return forward_error(done);
    if (const Status idle = device.wait_idle(); !idle) return forward_error(idle);
    cost.frame_ms = milliseconds_since(start);
    cost.upload_bytes = device.counters().uploaded_bytes - uploaded;
    return cost;
}

}  // namespace gnomon::report::internal

namespace gnomon::report {

std::vector<std::string> technique_names(bool quick) {
    std::vector<std::string> names;
    for (const internal::Entry& entry : internal::all_techniques()) {
        if (entry.quick || !quick) names.push_back(entry.name);
    }
    return names;
}

}  // namespace gnomon::report
