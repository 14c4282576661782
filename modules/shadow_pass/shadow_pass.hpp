// SPDX-License-Identifier: MIT
//
// ShadowPass: turns a DrawList into GPU commands. It uploads the indices that changed and records,
// per light, the stencil counting of its volumes into a render pass of the caller's. Where the
// stencil is zero afterwards, the light arrives. It owns no target, draws no scene and knows no
// light's colour.
//
//     pass.prepare(list, view);                          // once a frame
//     for (size_t i = 0; i < list.lights.size(); ++i) {
//         auto encoder = commands.begin_render_pass(…);  // stencil cleared to 0, the scene's depth
//         loaded pass.record(encoder, i); …draw the scene lit, stencil compare Equal to 0, depth
//         compare Equal…
//     }
//
// Depth is reversed (1 near, 0 far, cleared to 0) and must come from the same position function and
// matrix product: clip_from_world(view) * world_from_local in double precision, rounded once. Where
// it cannot, casters ask for NearCaps::Averted and the pass for a cap bias (docs/conventions.md,
// "Near caps on averted faces").
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadow_pass {

/// Where far vertices are made.
enum class ExtrusionPath : std::uint8_t {
    VertexShader,  ///< a moving light uploads indices alone
    Cpu,  ///< vertices are uploaded every frame; for tests, and hosts whose vertex stage is not
          ///< theirs
};

/// What the mask says on the averted faces of a solid that carry its near caps
/// (shadows::NearCaps::Averted). On every other surface the mask is the same either way.
enum class AvertedFaces : std::uint8_t {
    /// In shadow, like everything behind the solid.
    Shadowed,
    /// Not shadowed by the solid itself; whether they are lit is left to shading, by N.L. So smooth
    /// normals do not show the triangles where the light grazes them (the shadow terminator). Caps
    /// on averted faces are drawn by depth-pass as well.
    LeftToShading,
};

/// Moves near caps off the surfaces that they lie on, for a depth buffer that came from the host's
/// own shaders: away from the eye, and with AvertedFaces::LeftToShading those on averted faces
/// towards it. As gpu::DepthStencilState has it: `constant` in the depth buffer's smallest steps,
/// `slope_scale` in steps of one pixel along the surface.
///
/// What may be decided wrongly is a surface that lies between a cap and where the bias moves it,
/// and nothing else (docs/numerics.md, "Near caps").
struct CapBias {
    std::int32_t constant = 0;  ///< steps of depth
    float slope_scale = 0.0F;   ///< pixels along the surface

    /// Whether nothing is moved.
    [[nodiscard]] bool none() const { return constant == 0 && slope_scale == 0.0F; }
};

/// Enough, as measured in docs/numerics.md, for a host that multiplies its matrices one after the
/// other in single precision, in a world whose origin is the eye. The slope covers vertices that
/// snap to a neighbouring place on the rasteriser's grid, of 1/256 pixel, in x and in y; twice.
inline constexpr CapBias usual_cap_bias{4, 1.0F / 64.0F};

/// What volumes are drawn into, and how.
struct ShadowPassDesc {
    gpu::Format depth_stencil_format =
        gpu::Format::Depth32FloatStencil8;  ///< of the attachment; with a stencil
    /// "In front of", strictly: caps lie on surfaces, and equality must count as behind. Less where
    /// a host's depth runs forward.
    gpu::Compare depth_compare = gpu::Compare::Greater;
    /// The clip space of the view that is drawn has depth from -1 to 1 (OpenGL's own), not from 0.
    bool clip_from_minus_one = false;
    std::uint32_t sample_count = 1;  ///< of the attachments, 1 or 4
    std::vector<gpu::Format> color_formats =
        {};  ///< of the render pass that volumes are drawn in; none is written
    ExtrusionPath extrusion = ExtrusionPath::VertexShader;  ///< where far vertices are made
    bool silhouette_lines =
        false;               ///< also uploads silhouette edges as lines, for Part::Silhouettes
    bool cap_parts = false;  ///< also keeps all caps at hand, for Part::Caps
    /// Volumes that the GPU would make from quads on every edge (VolumeDraw::quads) are made by the
    /// CPU, at a cost linear in the mesh each frame: for record_part(), which has nothing of them
    /// otherwise. So it is with ExtrusionPath::Cpu in any case.
    bool expand_quads = false;
    AvertedFaces averted_faces = AvertedFaces::Shadowed;  ///< what the mask says there
    CapBias cap_bias = {};  ///< both values >= 0; none where depth comes from the shared function
    bool meter = false;     ///< also makes what record_fill() draws with
};

/// What a debug view may draw of a volume.
enum class Part : std::uint8_t {
    Sides,        ///< triangles
    Caps,         ///< near caps, triangles; needs ShadowPassDesc::cap_parts
    Silhouettes,  ///< lines
};

/// In pixels; of the whole attachments, which the viewport covers.
struct TargetSize {
    std::uint32_t width = 0;   ///< pixels
    std::uint32_t height = 0;  ///< pixels
    bool operator==(const TargetSize&) const = default;
};

/// Which stencil fragments record_fill() lets through to an occlusion query. All are samples: four
/// a covered pixel where there are four.
enum class Fill : std::uint8_t {
    Rasterised,  ///< all that volumes cover, what rasterisation and the stencil test cost
    Counted,     ///< those that change the count: before the scene by depth-pass, not before it by
                 ///< depth-fail
    PerPixel,    ///< as Rasterised, and the stencil of each sample counts its own, up to 255
};

/// Of the last prepare().
struct PassStats {
    std::uint64_t uploaded_bytes = 0;       ///< indices, matrices and vertices
    std::uint64_t draw_calls = 0;           ///< that record() makes for all lights together
    std::uint64_t index_bytes_held = 0;     ///< index memory in use
    std::uint64_t hidden_draws = 0;         ///< volumes with empty bounds: not drawn
    std::uint64_t depth_bounded_draws = 0;  ///< volumes cut to depths (VolumeDraw::depth); none
                                            ///< where the adapter has no depth bounds
};

/// Turns a draw list into stencil counts within a render pass of the host's.
class ShadowPass {
public:
    /// The device must outlive the pass. Fails as the device's create functions do, and with
    /// ErrorCode::InvalidInput for a cap bias that is negative.
    [[nodiscard]] static Result<ShadowPass> create(gpu::Device& device, const ShadowPassDesc& desc);
    ShadowPass(ShadowPass&&) noexcept;
    ShadowPass& operator=(ShadowPass&&) noexcept;
    ~ShadowPass();

    /// Uploads what the list needs and the GPU does not have: where nothing moved but the camera,
    /// 148 bytes a volume of matrices; where a caster moved, those of its volumes. Nothing is done
    /// for the list of the last call (DrawList::revision) and the same view. The list is remembered
    /// until the next call. A view may be mirrored (shadows::is_mirrored), y pointing down for
    /// instance.
    ///
    /// `target` is the size of what record() will draw into: volumes are then cut to the pixels
    /// that they can change (VolumeDraw::bounds). Without it none is. Where the adapter has depth
    /// bounds, depth is reversed and its range whole (0 .. 1), volumes are cut to the depths that
    /// they can change as well (VolumeDraw::depth).
    [[nodiscard]] Status prepare(const shadows::DrawList& list, const shadows::View& view,
                                 TargetSize target = {});

    /// Records the volumes of list.lights[light]. The pass's stencil must have been cleared to 0;
    /// its depth buffer is read, not written. Afterwards the stencil is 0 where the light arrives;
    /// elsewhere it is the count, or 255 where the light's volumes come in several batches
    /// (LightDraws::batches). Those are folded in place, by draws that cover the viewport: one a
    /// batch and one more. Where volumes end (LightDraws::clear_background), one more draw sets the
    /// stencil to 0 where depth is what it was cleared to. Leaves pipeline, bind groups 0 and 1,
    /// vertex slots 0 and 1, index buffer, stencil reference and, where prepare() was told the
    /// target's size, the scissor changed: it covers the target; depth bounds are 0 .. 1.
    void record(gpu::RenderPassEncoder& encoder, std::size_t light) const;

    /// Another after each prepare() that changed what record() records. While it stays, and the
    /// list's lights do, a host may submit again what it recorded: what moved lies in buffers.
    [[nodiscard]] std::uint64_t revision() const;

    /// Draws what record() draws, the same triangles under the same scissors, so that the samples
    /// of `fill` pass and no others do: within an occlusion query of the caller's their number is
    /// exact, whatever the device (count_fill() in fill_meter.hpp does all of it). Depth is read
    /// and not written; the stencil is left alone but for Fill::PerPixel. Not drawn are the folds
    /// of batches: LightDraws::batches + 1 times the viewport where there are several. Needs
    /// ShadowPassDesc::meter. Cost: about that of record(). Leaves changed what record() does.
    void record_fill(gpu::RenderPassEncoder& encoder, std::size_t light, Fill fill) const;

    /// For debug views: draws one part of a light's volumes with a pipeline of the caller's, whose
    /// vertex stage is vertex_shader() and whose vertex slots are vertex_layouts(). It reads no
    /// bind group.
    void record_part(gpu::RenderPassEncoder& encoder, std::size_t light, Part part,
                     gpu::RenderPipelineId pipeline) const;
    /// For pipelines of record_part().
    [[nodiscard]] gpu::ShaderId vertex_shader() const;
    /// For pipelines of record_part().
    [[nodiscard]] std::vector<gpu::VertexBufferLayout> vertex_layouts() const;

    /// Of the last prepare().
    [[nodiscard]] const PassStats& stats() const;

private:
    struct State;
    explicit ShadowPass(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::shadow_pass
#pragma GCC visibility pop
