// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>
#include <tuple>

#include <gnomon_shaders/report.hpp>

#include "internal/baselines.hpp"

namespace gnomon::report::internal {

std::optional<glm::dvec4> main_plane(const scene::Scene& scene, const glm::dvec3& eye) {
    const scene::Bounds bounds = scene::world_bounds(scene);
    if (bounds.empty()) return std::nullopt;
    const double step = std::max(1e-4 * bounds.diagonal(), 1e-9);
    struct Candidate {
        double area = 0.0;
        glm::dvec4 sum{0.0};
    };
    // Planes that are the same but for rounding, or almost, fall into one place or two.
    std::map<std::tuple<int, int, int, long>, Candidate> planes;
    scene.registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& instance,
            const scene::WorldTransform& world) {
            const auto geometry = scene::geometry_of(scene.registry, entity, instance, world);
            const auto at = [&](std::size_t i) {
                return glm::dvec3(
                    geometry.world_from_positions *
                    glm::dvec4(glm::dvec3(geometry.positions[instance.mesh->indices[i]]), 1.0));
            };
            for (std::size_t i = 0; i + 2 < instance.mesh->indices.size(); i += 3) {
                const glm::dvec3 a = at(i);
                const glm::dvec3 twice = glm::cross(at(i + 1) - a, at(i + 2) - a);
                const double area = glm::length(twice) * 0.5;
                if (!(area > 0.0)) continue;
                glm::dvec3 normal = twice / (2.0 * area);
                if (normal.y < -1e-6 ||
                    (std::abs(normal.y) <= 1e-6 && glm::dot(normal, eye - a) < 0.0)) {
                    normal = -normal;
                }
                const double offset = -glm::dot(normal, a);
                Candidate& c = planes[{static_cast<int>(std::lround(normal.x * 1000.0)),
                                       static_cast<int>(std::lround(normal.y * 1000.0)),
                                       static_cast<int>(std::lround(normal.z * 1000.0)),
                                       std::lround(offset / step)}];
                c.area += area;
                c.sum += area * glm::dvec4(normal, offset);
            }
        });
    const Candidate* best = nullptr;
    for (const auto& [place, candidate] : planes) {
        if (best == nullptr || candidate.area > best->area) best = &candidate;
    }
    if (best == nullptr) return std::nullopt;
    const glm::dvec4 plane = best->sum / best->area;
    return plane / glm::length(glm::dvec3(plane));
}

namespace {

class Planar final : public DrawnTechnique {
public:
    Planar(const Setup& setup, const glm::dvec4& plane)
        : DrawnTechnique(setup.stage), plane_(plane), least_m_(1e-4 * setup.bounds.diagonal()) {}

    Status create();
    Result<FrameCost> frame(const Moment& moment, bool look) override;

private:
    glm::dvec4 plane_;
    double least_m_;  // what is nearer to the plane casts nothing: it lies in it
    gpu::Shader vertex_;
    gpu::Shader fragment_;
    gpu::RenderPipeline pipeline_;
    DrawMatrices matrices_;
};

Status Planar::create() {
    gpu::Device& device = stage_.device();
    auto vertex = device.create_shader(
        {.label = "flattened", .stage = gpu::ShaderStage::Vertex, .source = shaders::flat_vert});
    if (!vertex) return forward_error(vertex);
    vertex_ = std::move(*vertex);
    auto fragment = device.create_shader(
        {.label = "flattened", .stage = gpu::ShaderStage::Fragment, .source = shaders::flat_frag});
    if (!fragment) return forward_error(fragment);
    fragment_ = std::move(*fragment);
    auto pipeline = device.create_render_pipeline(
        {.label = "flattened",
         .bind_group_layouts = {stage_.draw_layout()},
         .vertex = vertex_,
         .fragment = fragment_,
         .vertex_buffers = {Stage::position_layout()},
         // Towards the eye, so that it wins against the plane that it lies in.
         .depth_stencil = gpu::DepthStencilState{.format = gpu::Format::Depth32FloatStencil8,
                                                 .depth_compare = gpu::Compare::GreaterEqual,
                                                 .depth_bias = 256,
                                                 .depth_bias_slope_scale = 1.0F},
         .targets = {{.format = mask_format}}});
    if (!pipeline) return forward_error(pipeline);
    pipeline_ = std::move(*pipeline);
    return {};
}

Result<FrameCost> Planar::frame(const Moment& moment, bool /*look*/) {
    gpu::Device& device = stage_.device();
    const auto start = Clock::now();
    const std::uint64_t uploaded = device.counters().uploaded_bytes;
    const auto instances = stage_.instances(*moment.scene);
    const glm::dmat4 clip_from_world = moment.view.clip_from_world();
    matrices_.clear();
    std::vector<std::uint32_t> offsets;
    for (const StageInstance& instance : instances) {
        offsets.push_back(
            matrices_.add(glm::mat4(clip_from_world * instance.world_from_local), glm::mat4(1.0F)));
    }
    std::vector<std::vector<std::uint32_t>> flattened(moment.lights.size());
    for (std::size_t light = 0; light < moment.lights.size(); ++light) {
        const glm::dvec4 l = moment.lights[light].position_world;
        const double height = glm::dot(plane_, l);
        if (!(height > 0.0)) continue;  // it shines on the plane's other side
        const glm::dmat4 flatten =
            (height * glm::dmat4(1.0) - glm::outerProduct(l, plane_)) / height;
        for (const StageInstance& instance : instances) {
            if (!instance.casts) continue;
            glm::dvec4 above = glm::transpose(instance.world_from_local) * plane_;
            above.w -= least_m_;
            flattened[light].push_back(matrices_.add(
                glm::mat4(clip_from_world * flatten * instance.world_from_local),
                glm::mat4(glm::vec4(above), glm::vec4(0.0F), glm::vec4(0.0F), glm::vec4(0.0F))));
        }
    }
    if (const Status done = matrices_.upload(device, stage_.draw_layout()); !done) {
        return forward_error(done);
    }
    constexpr gpu::Format format = gpu::Format::Depth32FloatStencil8;
    auto depth = stage_.depth_stencil(format);
    if (!depth) return forward_error(depth);
    auto pipeline = stage_.depth_pipeline(format, DepthRange::Reversed);
    if (!pipeline) return forward_error(pipeline);
    auto encoder = device.create_command_encoder("frame");
    stage_.record_depth(encoder, *pipeline, *depth, DepthRange::Reversed, instances, matrices_,
                        offsets);
    for (std::size_t light = 0; light < moment.lights.size(); ++light) {
        auto pass = encoder.begin_render_pass(
            {.label = "flattened casters",
             .color_attachments = {{.texture = stage_.mask(light), .load_op = gpu::LoadOp::Clear}},
             .depth_stencil = gpu::DepthStencilAttachment{.texture = *depth}});
        pass.set_pipeline(pipeline_);
        std::size_t next = 0;
        for (const StageInstance& instance : instances) {
            if (!instance.casts || next >= flattened[light].size()) continue;
            Stage::draw(pass, instance, matrices_.group(), flattened[light][next++]);
        }
    }
    return draw_and_wait(device, encoder, start, uploaded);
}

}  // namespace

Result<std::unique_ptr<Technique>> create_planar(const Setup& setup) {
    const glm::dvec3 eye(glm::inverse(setup.view.view_from_world)[3]);
    const auto plane = main_plane(setup.subject.scene, eye);
    if (!plane) return fail(ErrorCode::Unsupported, "There is no plane to cast shadows on.");
    auto technique = std::make_unique<Planar>(setup, *plane);
    if (const Status created = technique->create(); !created) return forward_error(created);
    return technique;
}

}  // namespace gnomon::report::internal
