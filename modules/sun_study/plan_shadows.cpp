// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/plan_shadows.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <gnomon/core/expects.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

namespace gnomon::sun_study {

namespace {

constexpr gpu::Format depth_stencil_format = gpu::Format::Depth32FloatStencil8;
// Of the plane, in a view that ends a third as far below it as it begins above: exact in a float.
constexpr float plane_depth = 0.25F;

double top_of(const std::vector<shadows::Caster>& casters) {
    double top = 0.0;
    for (const shadows::Caster& caster : casters) {
        const shadows::OrientedBounds box{caster.world_from_local, caster.mesh->bounds_min(),
                                          caster.mesh->bounds_max()};
        for (const glm::dvec3& corner : shadows::corners_of(box)) top = std::max(top, corner.y);
    }
    return top;
}

// From above all casters straight down, the plan upright, its plane at plane_depth.
shadows::View view_from_above(const PlanGrid& grid, double top_m) {
    const double eye_m = std::max(1.25 * top_m, 1.0);
    const glm::dvec2 half = grid.size_m() * 0.5;
    return {shadows::look_at({0.0, eye_m, 0.0}, glm::dvec3(0.0), {0.0, 0.0, -1.0}),
            shadows::orthographic(half.x, half.y, 0.0, eye_m / (1.0 - plane_depth)),
            shadows::ProjectionKind::Orthographic};
}

}  // namespace

struct PlanShadows::State {
    gpu::Device* device = nullptr;
    PlanGrid grid;
    shadows::View view;
    std::vector<shadows::Caster> casters;  // about the grid's middle
    shadows::ShadowSystem system;
    shadow_pass::ShadowPass pass;
    gpu::Texture depth_stencil;
    shadows::FrameStats stats;
};

PlanShadows::PlanShadows(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanShadows::PlanShadows(PlanShadows&&) noexcept = default;
PlanShadows& PlanShadows::operator=(PlanShadows&&) noexcept = default;
PlanShadows::~PlanShadows() = default;

Result<PlanShadows> PlanShadows::create(gpu::Device& device, std::vector<shadows::Caster> casters,
                                        const PlanGrid& grid, const PlanShadowsOptions& options) {
    const std::uint32_t limit = device.caps().limits.max_texture_dimension_2d;
    if (grid.columns > limit || grid.rows > limit) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The grid of {} x {} cells is larger than {} draws at a time; its "
                                "limit is {} a side.",
                                grid.columns, grid.rows, device.caps().adapter, limit));
    }
    auto system = shadows::ShadowSystem::create({.silhouette = options.silhouette,
                                                 .jobs = options.jobs,
                                                 .receivers = shadows::Receivers::Submitted});
    if (!system) return forward_error(system);
    auto pass =
        shadow_pass::ShadowPass::create(device, {.depth_stencil_format = depth_stencil_format});
    if (!pass) return forward_error(pass);
    auto depth_stencil = device.create_texture(
        {.label = "plan",
         .width = grid.columns,
         .height = grid.rows,
         .format = depth_stencil_format,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
    if (!depth_stencil) return forward_error(depth_stencil);

    const glm::dvec2 middle = grid.min_m + grid.size_m() * 0.5;
    const glm::dvec3 middle_world = world_from_plan(glm::dvec3(middle, grid.height_m));
    for (shadows::Caster& caster : casters) {
        caster.world_from_local[3] -= glm::dvec4(middle_world, 0.0);
        caster.in_depth_buffer = false;
    }
    const shadows::View view = view_from_above(grid, top_of(casters));
    return PlanShadows(std::unique_ptr<State>(new State{&device,
                                                        grid,
                                                        view,
                                                        std::move(casters),
                                                        std::move(*system),
                                                        std::move(*pass),
                                                        std::move(*depth_stencil),
                                                        {}}));
}

Result<PlanMask> PlanShadows::lit(const glm::dvec3& towards_sun_plan) {
    GNOMON_EXPECTS(towards_sun_plan.z > 0.0);
    State& s = *state_;
    auto frame = s.system.begin_frame();
    for (const shadows::Caster& caster : s.casters) frame.caster(caster);
    const glm::dvec2 half = s.grid.size_m() * 0.5;
    frame.receiver(
        {.key = 1, .bounds = {.min = {-half.x, 0.0, -half.y}, .max = {half.x, 0.0, half.y}}});
    frame.light({.key = 1, .position_world = glm::dvec4(world_from_plan(towards_sun_plan), 0.0)});
    const shadows::DrawList& list = std::move(frame).finish(s.view);
    s.stats = list.stats;
    if (const Status done = s.pass.prepare(list, s.view, {s.grid.columns, s.grid.rows}); !done) {
        return forward_error(done);
    }
    auto encoder = s.device->create_command_encoder("plan");
    {
        auto pass = encoder.begin_render_pass(
            {.label = "plan",
             .depth_stencil = gpu::DepthStencilAttachment{.texture = s.depth_stencil,
                                                          .depth_load_op = gpu::LoadOp::Clear,
                                                          .depth_clear_value = plane_depth,
                                                          .stencil_load_op = gpu::LoadOp::Clear}});
        s.pass.record(pass, 0);
    }
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    if (const Status done = s.device->submit(*commands); !done) return forward_error(done);
    const auto counts = s.device->read_texture(s.depth_stencil, gpu::Aspect::StencilOnly);
    if (!counts) return forward_error(counts);
    PlanMask mask(counts->size());
    std::ranges::transform(*counts, mask.begin(), [](std::byte count) {
        return static_cast<std::uint8_t>(count == std::byte{0});
    });
    return mask;
}

const shadows::FrameStats& PlanShadows::stats() const { return state_->stats; }

}  // namespace gnomon::sun_study
