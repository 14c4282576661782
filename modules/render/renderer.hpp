// SPDX-License-Identifier: MIT
//
// Renderer: the small renderer that gnomon's own apps share. Depth first; then, light by light, the
// volumes are counted into the stencil, and where the count is not zero the light loses its bit in
// a mask; then the scene is drawn once more, lit by all lights at once (once more for every eight).
// A decent material, any number of lights, debug views of everything the shadows are made of. It is
// not an engine; embedders use gnomon::shadow_pass.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadow_pass/fill_meter.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::render {

/// Debug views, any of them together.
struct Overlays {
    bool volumes = false;      ///< the volumes' sides, yellow
    bool silhouettes = false;  ///< silhouette edges, pink
    bool caps = false;         ///< near caps, turquoise
    bool wireframe = false;    ///< all triangles of the scene
    bool count = false;        ///< the stencil count as a heat map
    /// Stencil fragments a sample, of all lights together, as a heat map of powers of two, from
    /// blue (1), cyan (2 and 3) and green (4 to 7) by yellow and red to white (128 and more). The
    /// stencil then holds their number.
    bool fill = false;

    /// Whether anything is shown.
    [[nodiscard]] bool any() const {
        return volumes || silhouettes || caps || wireframe || count || fill;
    }
    bool operator==(const Overlays&) const = default;
};

/// What is drawn into, and what is shown.
struct RendererDesc {
    std::uint32_t width = 1280;      ///< pixels
    std::uint32_t height = 720;      ///< pixels
    std::uint32_t sample_count = 1;  ///< 1 or 4
    gpu::Format depth_stencil_format =
        gpu::Format::Depth32FloatStencil8;  ///< of the attachment; with a stencil
    shadow_pass::ExtrusionPath extrusion =
        shadow_pass::ExtrusionPath::VertexShader;  ///< where far vertices are made
    gpu::Compare volume_depth_compare =
        gpu::Compare::Greater;  ///< for experiments: anything else is wrong here
    /// LeftToShading goes with casters of shadows::NearCaps::Averted: their faces are then shaded
    /// by smooth normals alone, where otherwise light that grazes a triangle fades out.
    shadow_pass::AvertedFaces averted_faces = shadow_pass::AvertedFaces::Shadowed;
    bool cull_back_faces = false;  ///< default: both sides of every triangle go into depth
    Overlays overlays = {};        ///< debug views
    bool meter_fill = false;       ///< for Renderer::measure_fill()
    bool operator==(const RendererDesc&) const = default;
};

/// What there is without any light, and how bright lights come out. Linear; the defaults are a
/// neutral day, whose exposure suits whatever is lit.
struct Environment {
    glm::vec3 sky{0.135F, 0.165F, 0.215F};      ///< what comes from straight above
    glm::vec3 ground{0.075F, 0.066F, 0.058F};   ///< and from straight below
    glm::vec3 background{0.20F, 0.26F, 0.34F};  ///< where nothing is drawn
    /// By which lux and candela are multiplied. Without it, such that the strongest light on the
    /// scene exposes a white surface well: then the picture's brightness follows lights that move.
    std::optional<float> exposure = std::nullopt;
};

/// What one frame is drawn from. All of it is read during render() alone.
struct FrameInput {
    const scene::Scene&
        scene;  ///< world transforms up to date; upload() has seen its meshes and materials
    const shadows::View& view;         ///< the one that `shadows` was made for
    const shadows::DrawList& shadows;  ///< what ShadowSystem made of the scene
    /// Called after each light's stencil count is complete (the device has been given the work):
    /// what may be read then is depth_stencil(). The light is named by its place in shadows.lights.
    /// In order; without it, lights whose range the view does not reach are left out.
    std::function<Status(std::size_t light)> after_light = {};
    /// Lights that are not in `shadows` and shine all the same, through everything
    /// (choose_shadowed_lights()).
    std::span<const scene::Entity> unshadowed = {};
    Environment environment = {};  ///< what there is without any light
};

/// Of the last render(), on the CPU.
struct FrameTimes {
    double record_ms = 0.0;  ///< uniforms, uploads, commands, validation
    double submit_ms = 0.0;  ///< inside the device; the callback's time is in neither
    /// False where the last frame's commands were submitted again: poses and lights may have moved,
    /// as long as volumes and what they are cut to stayed.
    bool recorded = true;
};

/// Draws scenes with their shadows.
class Renderer {
public:
    /// The device must outlive the renderer.
    [[nodiscard]] static Result<Renderer> create(gpu::Device& device, const RendererDesc& desc);
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// Meshes and materials of a scene. Call it again when some are added or replaced; poses,
    /// lights and deformed vertices are read by render(), the last uploaded when they changed.
    [[nodiscard]] Status upload(const scene::Scene& scene);

    /// Goes on with another description, as if created with it, and keeps the scene that was
    /// uploaded: for windows whose size changes, and debug views that come and go. Cost: the
    /// targets where only the size differs; else pipelines as well, and volumes are uploaded anew;
    /// nothing where nothing differs. picture() and depth_stencil() are others then. Fails as
    /// create() does; after that, draw with a new renderer.
    [[nodiscard]] Status reconfigure(const RendererDesc& desc);

    /// One frame, submitted; does not wait for the device.
    [[nodiscard]] Status render(const FrameInput& frame);

    /// Stencil fragments of the last render(), one entry a light, in the order of its draw list; 0
    /// for what was left out. As shadow_pass::count_fill() counts. Blocks until the device has
    /// counted; the picture and the stencil stay as they are. Needs RendererDesc::meter_fill. Empty
    /// before the first render(), and again after a reconfigure() that changed anything.
    [[nodiscard]] Result<std::vector<shadow_pass::LightFill>> measure_fill();

    /// The finished picture: Rgba8Unorm, already sRGB-encoded.
    [[nodiscard]] gpu::TextureId picture() const;
    /// The depth-stencil buffer; its stencil holds the count of the last light of
    /// FrameInput::shadows, 0 where that was left out.
    [[nodiscard]] gpu::TextureId depth_stencil() const;
    /// Of the last render().
    [[nodiscard]] const shadow_pass::PassStats& shadow_stats() const;
    /// Of the last render().
    [[nodiscard]] FrameTimes times() const;
    /// As it was created or reconfigured.
    [[nodiscard]] const RendererDesc& desc() const;

private:
    struct State;
    explicit Renderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// One byte a pixel and sample, row 0 on top: the stencil of depth_stencil(), as it is then. Sample
/// 0 where there is only one.
[[nodiscard]] Result<std::vector<std::byte>> read_stencil(gpu::Device& device,
                                                          const Renderer& renderer,
                                                          std::uint32_t sample = 0);

}  // namespace gnomon::render
#pragma GCC visibility pop
