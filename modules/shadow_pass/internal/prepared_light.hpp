// SPDX-License-Identifier: MIT
//
// PreparedLight: one light's volumes as draw calls in the order in which they are recorded, and
// what they were made from, so that they are made again only when that changes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <gnomon/gpu/handle.hpp>
#include <gnomon/shadows/screen_bounds.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#include "buffer_arena.hpp"
#include "volume_draws.hpp"

namespace gnomon::shadow_pass::internal {

/// A draw call and all of the state that it needs.
struct Call {
    gpu::BufferId vertices;     ///< none for quads
    gpu::BufferId indices;      ///< none for quads
    gpu::BindGroupId textures;  ///< for quads
    shadows::PixelRect scissor;
    shadows::DepthBounds depth;
    std::uint32_t first = 0;  ///< vertex or index
    std::uint32_t count = 0;
    std::int32_t base_vertex = 0;
    std::uint32_t instance = 0;  ///< for quads: the offset of their uniforms, in bytes
    std::uint32_t batch = 0;
    std::uint8_t pipeline = 0;  ///< pipeline_index()
    shadows::QuadFacing quads = shadows::QuadFacing::None;
};

/// Brings the calls of each batch into an order with few changes of state: by vertex stage,
/// pipeline, whether there is a scissor (`everything`: there is none), depth bounds and buffers.
/// Counts are sums, so that no order of volumes within a batch changes a byte.
void sort_calls(std::vector<Call>& calls, const shadows::PixelRect& everything);

/// All that the calls of a draw, or of one of its slabs, depend on.
struct DrawKey {
    std::uint64_t revision = 0;
    std::uint64_t mesh = 0;
    std::uint32_t instance = 0;  ///< its element of VolumeInstances
    shadows::PixelRect wanted;   ///< the scissor that its bounds ask for
    shadows::PixelRect scissor;  ///< and what was chosen
    shadows::DepthBounds depth;  ///< where the adapter has such
    std::uint32_t batch = 0;
    shadows::Technique technique = shadows::Technique::DepthFail;
    Ends ends;
    bool mirrored = false;
    bool hidden = false;
    bool operator==(const DrawKey&) const = default;
};

/// What debug views draw of a volume.
struct VolumeParts {
    std::uint32_t instance = 0;
    gpu::BufferId vertices;
    std::int32_t base_vertex = 0;
    ArenaRun indices;
    std::uint32_t indices_begin = 0;  ///< what of Volume::indices is there first
    ArenaRun mesh_caps;
    std::shared_ptr<const shadows::Volume> volume;
    std::vector<Run> near_caps;  ///< for Part::Caps, where it may be asked for
};

struct PreparedLight {
    shadows::LightDraws draws;  ///< what it was made for
    bool finite = false;        ///< under a view with a far plane
    std::vector<DrawKey> keys;
    /// Where what it uses says when it was used last.
    std::vector<std::uint64_t*> marks;
    std::vector<Call> calls;
    std::vector<VolumeParts> parts;
    std::uint64_t draw_calls = 0;  ///< that record() makes
    std::uint64_t hidden_draws = 0;
    std::uint64_t depth_bounded_draws = 0;
    bool known = false;  ///< false: to be made anew
};

}  // namespace gnomon::shadow_pass::internal
