// SPDX-License-Identifier: MIT
//
// Shadows: what the package for web pages is made of (package/index.js): meshes, casters, lights
// and views of a page, by number, and masks of them in textures of the page's. It is a shadow
// system that is told of changes alone, and light masks on an adopted device; it knows nothing of a
// scene. Numbers and arguments come from index.js, which has checked them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/light_masks.hpp>
#include <gnomon/shadows/shadow_system.hpp>

namespace gnomon::npm {

/// Things by number, whose numbers are given again once they are gone.
template <class Thing>
class Numbered {
public:
    std::uint32_t add(Thing thing) {
        if (free_.empty()) {
            things_.emplace_back(std::move(thing));
            return static_cast<std::uint32_t>(things_.size() - 1);
        }
        const std::uint32_t number = free_.back();
        free_.pop_back();
        things_[number].emplace(std::move(thing));
        return number;
    }
    [[nodiscard]] bool has(std::uint32_t number) const {
        return number < things_.size() && things_[number].has_value();
    }
    void remove(std::uint32_t number) {
        things_[number].reset();
        free_.push_back(number);
    }
    Thing& operator[](std::uint32_t number) { return *things_[number]; }

private:
    std::vector<std::optional<Thing>> things_;
    std::vector<std::uint32_t> free_;
};

class Shadows {
public:
    using Mesh = std::shared_ptr<const shadows::ShadowMesh>;

    /// How a caster is; values of index.js.
    struct Manner {
        bool visible = true;
        bool in_depth = true;
        bool averted_caps = false;
    };

    /// Textures of a view, by the numbers that Bridge.adopt() answered.
    struct ViewDesc {
        std::uint32_t depth = 0;  ///< Depth32FloatStencil8
        shadow_pass::TargetSize size;
        std::uint32_t sample_count = 1;
        bool reversed = false;
        bool bits = true;  ///< one mask of R32Uint, else R8Unorm a light
        std::span<const std::uint32_t> masks = {};
    };

    /// On the bridge of this module.
    [[nodiscard]] static Result<std::unique_ptr<Shadows>> create(shadow_pass::CapBias cap_bias);

    [[nodiscard]] Result<std::uint32_t> add_mesh(const shadows::MeshView& triangles);
    [[nodiscard]] Result<std::uint32_t> add_deformed(std::uint32_t mesh,
                                                     std::span<const glm::vec3> positions);
    [[nodiscard]] const shadows::ShadowMesh& mesh(std::uint32_t mesh) { return *meshes_[mesh]; }
    /// Casters keep theirs.
    void remove_mesh(std::uint32_t mesh) { meshes_.remove(mesh); }

    std::uint32_t add_caster(std::uint32_t mesh, const glm::dmat4& world_from_local, Manner manner);
    void place(std::uint32_t caster, const glm::dmat4& world_from_local);
    void change(std::uint32_t caster, Manner manner);
    void change_mesh(std::uint32_t caster, std::uint32_t mesh);
    void remove_caster(std::uint32_t caster);

    /// Lights 0 to 31 are bits of the masks.
    void set_light(std::uint32_t bit, const glm::dvec4& position_world,
                   std::optional<double> range_m);
    /// Its bit is 0 from then on.
    void remove_light(std::uint32_t bit);

    [[nodiscard]] Result<std::uint32_t> add_view(const ViewDesc& desc);
    void remove_view(std::uint32_t view) { views_.remove(view); }
    /// Writes the masks of a view.
    [[nodiscard]] Status render(std::uint32_t view, const glm::dmat4& view_from_world,
                                const glm::dmat4& clip_from_view);

    /// Of the last render().
    [[nodiscard]] const shadows::FrameStats& frame_stats() const { return frame_stats_; }
    [[nodiscard]] const shadow_pass::PassStats& pass_stats() const { return pass_stats_; }

private:
    struct Caster {
        shadows::Caster caster;
        bool visible = true;
    };
    struct View {
        shadows::HostConventions conventions;
        gpu::Texture depth;
        std::vector<gpu::Texture> masks;
        std::optional<shadow_pass::LightMasks> light_masks;  // before its textures
    };

    Shadows(gpu::Device device, shadows::ShadowSystem system, shadow_pass::CapBias cap_bias);
    void changed(std::uint32_t caster);
    void submit(shadows::ShadowSystem::Frame& frame);

    gpu::Device device_;
    shadows::ShadowSystem system_;
    shadow_pass::CapBias cap_bias_;
    Numbered<Mesh> meshes_;
    Numbered<Caster> casters_;
    Numbered<View> views_;
    // By bit; where there is none but one behind it, one that is nowhere, so that bits stay.
    std::vector<std::optional<shadows::Light>> lights_;
    // What the system has not been told yet.
    std::vector<std::uint32_t> changed_casters_;  // submitted where they are visible, else gone
    std::vector<std::uint8_t> is_changed_;        // by caster
    bool lights_changed_ = false;
    std::size_t lights_told_ = 0;
    shadows::FrameStats frame_stats_;
    shadow_pass::PassStats pass_stats_;
};

}  // namespace gnomon::npm
