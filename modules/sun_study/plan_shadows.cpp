// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/plan_shadows.hpp>

#include <algorithm>
#include <utility>

#include <gnomon/core/expects.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

#include "internal/plan_tiles.hpp"

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
shadows::View view_from_above(const glm::dvec2& middle, const glm::dvec2& half, double top_m) {
    const double eye_m = std::max(1.25 * top_m, 1.0);
    const glm::dvec3 under = world_from_plan(glm::dvec3(middle, 0.0));
    return {shadows::look_at(under + glm::dvec3(0.0, eye_m, 0.0), under, {0.0, 0.0, -1.0}),
            shadows::orthographic(half.x, half.y, 0.0, eye_m / (1.0 - plane_depth)),
            shadows::ProjectionKind::Orthographic};
}

}  // namespace

struct PlanShadows::State {
    gpu::Device* device = nullptr;
    PlanGrid grid;
    std::vector<internal::PlanTile> tiles;
    std::uint32_t columns = 0;  // that are drawn at a time
    std::uint32_t rows = 0;
    double top_m = 0.0;
    std::vector<shadows::Caster> casters;  // about the grid's middle
    shadows::ShadowSystem system;
    shadow_pass::ShadowPass pass;
    gpu::Texture depth_stencil;
    shadows::FrameStats stats;

    Result<std::vector<std::byte>> counts(const internal::PlanTile& tile,
                                          const glm::dvec3& towards_sun);
};

PlanShadows::PlanShadows(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanShadows::PlanShadows(PlanShadows&&) noexcept = default;
PlanShadows& PlanShadows::operator=(PlanShadows&&) noexcept = default;
PlanShadows::~PlanShadows() = default;

Result<PlanShadows> PlanShadows::create(gpu::Device& device, std::vector<shadows::Caster> casters,
                                        const PlanGrid& grid, const PlanShadowsOptions& options) {
    const std::uint32_t wanted =
        options.most_cells_a_side > 0 ? options.most_cells_a_side : internal::usual_tile_side;
    const std::uint32_t side = std::min(wanted, device.caps().limits.max_texture_dimension_2d);
    const std::uint32_t columns = std::min(side, grid.columns);
    const std::uint32_t rows = std::min(side, grid.rows);
    auto system = shadows::ShadowSystem::create({.silhouette = options.silhouette,
                                                 .jobs = options.jobs,
                                                 .receivers = shadows::Receivers::Submitted});
    if (!system) return forward_error(system);
    auto pass =
        shadow_pass::ShadowPass::create(device, {.depth_stencil_format = depth_stencil_format});
    if (!pass) return forward_error(pass);
    auto depth_stencil = device.create_texture(
        {.label = "plan",
         .width = columns,
         .height = rows,
         .format = depth_stencil_format,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
    if (!depth_stencil) return forward_error(depth_stencil);

    const glm::dvec2 middle = grid.min_m + grid.size_m() * 0.5;
    const glm::dvec3 middle_world = world_from_plan(glm::dvec3(middle, grid.height_m));
    for (shadows::Caster& caster : casters) {
        caster.world_from_local[3] -= glm::dvec4(middle_world, 0.0);
        caster.in_depth_buffer = false;
    }
    const double top_m = top_of(casters);
    return PlanShadows(std::unique_ptr<State>(new State{&device,
                                                        grid,
                                                        internal::tiles_of(grid, side),
                                                        columns,
                                                        rows,
                                                        top_m,
                                                        std::move(casters),
                                                        std::move(*system),
                                                        std::move(*pass),
                                                        std::move(*depth_stencil),
                                                        {}}));
}

// By pixel of a tile's whole size, how many volumes it lies in.
Result<std::vector<std::byte>> PlanShadows::State::counts(const internal::PlanTile& tile,
                                                          const glm::dvec3& towards_sun) {
    const glm::dvec2 half = glm::dvec2(columns, rows) * (0.5 * grid.cell_m);
    const glm::dvec2 middle = internal::middle_of(tile, columns, rows, grid);
    const shadows::View view = view_from_above(middle, half, top_m);
    auto frame = system.begin_frame();
    for (const shadows::Caster& caster : casters) frame.caster(caster);
    const glm::dvec3 under = world_from_plan(glm::dvec3(middle, 0.0));
    const glm::dvec3 reach(half.x, 0.0, half.y);
    frame.receiver({.key = 1, .bounds = {.min = under - reach, .max = under + reach}});
    frame.light({.key = 1, .position_world = glm::dvec4(world_from_plan(towards_sun), 0.0)});
    const shadows::DrawList& list = std::move(frame).finish(view);
    stats = list.stats;
    if (const Status done = pass.prepare(list, view, {columns, rows}); !done) {
        return forward_error(done);
    }
    auto encoder = device->create_command_encoder("plan");
    {
        auto drawing = encoder.begin_render_pass(
            {.label = "plan",
             .depth_stencil = gpu::DepthStencilAttachment{.texture = depth_stencil,
                                                          .depth_load_op = gpu::LoadOp::Clear,
                                                          .depth_clear_value = plane_depth,
                                                          .stencil_load_op = gpu::LoadOp::Clear}});
        pass.record(drawing, 0);
    }
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    if (const Status done = device->submit(*commands); !done) return forward_error(done);
    return device->read_texture(depth_stencil, gpu::Aspect::StencilOnly);
}

Result<PlanMask> PlanShadows::lit(const glm::dvec3& towards_sun_plan) {
    GNOMON_EXPECTS(towards_sun_plan.z > 0.0);
    State& s = *state_;
    PlanMask mask(s.grid.cell_count());
    for (const internal::PlanTile& tile : s.tiles) {
        const auto counts = s.counts(tile, towards_sun_plan);
        if (!counts) return forward_error(counts);
        for (std::uint32_t row = 0; row < tile.rows; ++row) {
            const auto first = counts->begin() + std::ptrdiff_t{row} * s.columns;
            const std::size_t cell = std::size_t{tile.row + row} * s.grid.columns + tile.column;
            std::transform(
                first, first + tile.columns, mask.begin() + static_cast<std::ptrdiff_t>(cell),
                [](std::byte count) { return static_cast<std::uint8_t>(count == std::byte{0}); });
        }
    }
    return mask;
}

const shadows::FrameStats& PlanShadows::stats() const { return state_->stats; }

}  // namespace gnomon::sun_study
