// SPDX-License-Identifier: MIT
#include "internal/plan_triangles.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace gnomon::sun_study::internal {

namespace {

using Corners = std::array<std::uint32_t, 3>;

struct PlaneSides {
    bool above = false;
    bool below = false;
};

// The faces of one caster, cut at the plane, with vertices numbered anew.
class Cutter {
public:
    Cutter(const shadows::Caster& caster, const glm::dvec3& middle_world,
           std::vector<glm::dvec3>& vertices)
        : vertices_(vertices) {
        glm::dmat4 about_middle = caster.world_from_local;
        about_middle[3] -= glm::dvec4(middle_world, 0.0);
        const auto positions = caster.mesh->positions();
        points_.reserve(positions.size());
        for (const glm::vec3& local : positions) {
            const glm::dvec3 world(about_middle * glm::dvec4(glm::dvec3(local), 1.0));
            points_.push_back(plan_from_world(world));
        }
        numbers_.assign(points_.size(), none);
    }

    // Of a face: whether any of it is above the plane, and below.
    [[nodiscard]] PlaneSides sides(const Corners& face) const {
        PlaneSides sides;
        for (const std::uint32_t corner : face) {
            sides.above = sides.above || points_[corner].z > 0.0;
            sides.below = sides.below || points_[corner].z < 0.0;
        }
        return sides;
    }

    // At most two triangles, wound as the face is.
    void cut(const Corners& face, std::vector<Corners>& out) {
        std::array<std::uint32_t, 4> polygon{};
        std::size_t count = 0;
        if (!sides(face).above) return;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t here = face[i];
            const std::uint32_t next = face[(i + 1) % 3];
            const double z = points_[here].z;
            const double z_next = points_[next].z;
            if (z >= 0.0) polygon[count++] = number_of(here);
            if ((z > 0.0 && z_next < 0.0) || (z < 0.0 && z_next > 0.0)) {
                polygon[count++] = z > 0.0 ? crossing(here, next) : crossing(next, here);
            }
        }
        for (std::size_t i = 2; i < count; ++i) {
            out.push_back({polygon[0], polygon[i - 1], polygon[i]});
        }
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::uint32_t number_of(std::uint32_t point) {
        if (numbers_[point] == none) numbers_[point] = add(points_[point]);
        return numbers_[point];
    }

    std::uint32_t crossing(std::uint32_t above, std::uint32_t below) {
        const std::uint64_t edge = (std::uint64_t{above} << 32U) | below;
        const auto [at, is_new] = crossings_.try_emplace(edge, 0);
        if (is_new) {
            const glm::dvec3& a = points_[above];
            const glm::dvec3& b = points_[below];
            glm::dvec3 point = a + (b - a) * (a.z / (a.z - b.z));
            point.z = 0.0;
            at->second = add(point);
        }
        return at->second;
    }

    std::uint32_t add(const glm::dvec3& point) {
        vertices_.push_back(point);
        return static_cast<std::uint32_t>(vertices_.size() - 1);
    }

    std::vector<glm::dvec3>& vertices_;
    std::vector<glm::dvec3> points_;
    std::vector<std::uint32_t> numbers_;
    std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
};

}  // namespace

PlanTriangles plan_triangles(std::span<const shadows::Caster> casters, const PlanGrid& grid) {
    const glm::dvec2 middle = grid.min_m + grid.size_m() * 0.5;
    const glm::dvec3 middle_world = world_from_plan(glm::dvec3(middle, grid.height_m));
    PlanTriangles triangles;
    std::vector<Corners> two_sided;
    for (const shadows::Caster& caster : casters) {
        const shadows::ShadowMesh& mesh = *caster.mesh;
        const double turns = glm::determinant(glm::dmat3(caster.world_from_local));
        Cutter cutter(caster, middle_world, triangles.vertices);
        std::vector<PlaneSides> sides(mesh.components().size());
        for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
            const PlaneSides of_face = cutter.sides(mesh.faces()[f]);
            PlaneSides& all = sides[mesh.face_components()[f]];
            all.above = all.above || of_face.above;
            all.below = all.below || of_face.below;
        }
        for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
            if (mesh.is_degenerate(f)) continue;
            const std::uint32_t c = mesh.face_components()[f];
            const shadows::Component& component = mesh.components()[c];
            // A pose without volume says nothing about sides; what it leaves is a sheet. Where a
            // component is cut, rays begin inside of it, and a part of it that is wound the other
            // way, whatever all of it is, they leave through a face that is turned away.
            const bool is_cut = sides[c].above && sides[c].below;
            const bool one_sided = component.closed && !is_cut && turns != 0.0;
            Corners face = mesh.faces()[f];
            if (component.inside_out != (turns < 0.0)) std::swap(face[1], face[2]);
            cutter.cut(face, one_sided ? triangles.faces : two_sided);
        }
    }
    triangles.one_sided = triangles.faces.size();
    triangles.faces.insert(triangles.faces.end(), two_sided.begin(), two_sided.end());
    return triangles;
}

}  // namespace gnomon::sun_study::internal
