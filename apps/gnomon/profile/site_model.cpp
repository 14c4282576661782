// SPDX-License-Identifier: MIT
#include "profile/site_model.hpp"

#include <cstring>
#include <limits>
#include <span>
#include <unordered_map>

#include <fnmatch.h>

#include <fmt/format.h>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::cli {

namespace {

// gnomon's world is +Y up and in metres.
glm::dmat4 world_from_model(const ProfileOptions& options) {
    const double u = options.unit_m;
    if (!options.z_up) return glm::dmat4(glm::dmat3(u));
    glm::dmat4 m(0.0);
    m[0][0] = u;
    m[1][2] = -u;
    m[2][1] = u;
    m[3][3] = 1.0;
    return m;
}

bool matches(const std::string& glob, const std::string& name) {
    return fnmatch(glob.c_str(), name.c_str(), 0) == 0;
}

// Those of a mesh's components whose NAME#K the glob matches, as one mesh; null where none does.
Result<std::shared_ptr<const shadows::ShadowMesh>> matching_components(
    const shadows::ShadowMesh& mesh, const std::string& name, const std::string& glob) {
    std::vector<bool> wanted(mesh.components().size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        wanted[k] = matches(glob, fmt::format("{}#{}", name, k));
    }
    std::vector<std::uint32_t> indices;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        if (!wanted[mesh.face_components()[f]]) continue;
        for (const std::uint32_t corner : mesh.faces()[f]) indices.push_back(corner);
    }
    if (indices.empty()) return nullptr;
    return shadows::ShadowMesh::build({.positions = std::as_bytes(mesh.positions()).data(),
                                       .vertex_count = mesh.positions().size(),
                                       .indices = indices});
}

Status keep_matching_casters(const scene::Registry& registry, const std::string& glob,
                             std::vector<shadows::Caster>& casters) {
    std::unordered_map<std::uint64_t, std::string> names;
    registry.each<scene::MeshInstance>([&](scene::Entity entity, const scene::MeshInstance&) {
        const auto* name = registry.try_get<scene::Name>(entity);
        names[entity.key()] = name == nullptr ? std::string() : name->value;
    });
    std::vector<shadows::Caster> kept;
    for (shadows::Caster& caster : casters) {
        const std::string& name = names[caster.key];
        if (!matches(glob, name)) {
            auto part = matching_components(*caster.mesh, name, glob);
            if (!part) return forward_error(part);
            if (*part == nullptr) continue;
            caster.mesh = std::move(*part);
        }
        kept.push_back(std::move(caster));
    }
    casters = std::move(kept);
    return {};
}

class Hash {  // FNV-1a
public:
    void add(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) {
            value_ = (value_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3ULL;
        }
    }
    [[nodiscard]] std::string text() const { return fmt::format("{:016x}", value_); }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

void measure(SiteModel& site) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 min(infinity);
    glm::dvec3 max(-infinity);
    Hash hash;
    for (const shadows::Caster& caster : site.casters) {
        hash.add(std::as_bytes(std::span(&caster.world_from_local, 1)));
        hash.add(std::as_bytes(caster.mesh->positions()));
        hash.add(std::as_bytes(caster.mesh->faces()));
        for (const auto& face : caster.mesh->faces()) {
            for (const std::uint32_t corner : face) {
                const glm::dvec3 world(
                    caster.world_from_local *
                    glm::dvec4(glm::dvec3(caster.mesh->positions()[corner]), 1.0));
                min = glm::min(min, world);
                max = glm::max(max, world);
            }
        }
    }
    site.hash = hash.text();
    // The plan's y runs against the world's z.
    site.min_plan = {min.x, -max.z, min.y};
    site.max_plan = {max.x, -min.z, max.y};
}

}  // namespace

Result<SiteModel> load_site(const ProfileOptions& options, const std::string& model,
                            const std::optional<std::string>& glob, const char* option,
                            bool may_be_empty) {
    auto loaded = scene::load_scene(model);
    if (!loaded) return forward_error(loaded);
    scene::update_world_transforms(loaded->registry);
    scene::ShadowAdapter adapter;
    auto casters = adapter.casters(*loaded);
    if (!casters) {
        return fail(casters.error().code, fmt::format("{}: {}", model, casters.error().message));
    }
    SiteModel site;
    site.notes = loaded->messages;
    site.casters = std::move(*casters);
    if (glob) {
        const Status kept = keep_matching_casters(loaded->registry, *glob, site.casters);
        if (!kept) return forward_error(kept);
    }
    std::erase_if(site.casters,
                  [](const shadows::Caster& caster) { return caster.mesh->faces().empty(); });
    if (site.casters.empty() && !may_be_empty) {
        if (glob) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("{}: \"{}\" matches no node of {} that has a mesh, and no "
                                    "component NAME#K of one.",
                                    option, *glob, model));
        }
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} has no mesh: nothing casts a shadow.", model));
    }
    const glm::dmat4 to_world = world_from_model(options);
    for (shadows::Caster& caster : site.casters) {
        caster.world_from_local = to_world * caster.world_from_local;
    }
    measure(site);
    return site;
}

}  // namespace gnomon::cli
