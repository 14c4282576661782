// SPDX-License-Identifier: MIT
//
// How often each stage of the facing test is reached on real models, at several distances of a mesh
// from the origin of its space: prints the table of docs/numerics.md. Models: $GNOMON_MODELS, else
// ../shared/models beside the source tree; skipped where there are none.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <gnomon/scene/gltf.hpp>
#include <gnomon/shadows/facing.hpp>

#include "tests/shadows/random_meshes.hpp"
#include "tests/support/paths.hpp"

namespace gnomon::shadows {
namespace {

struct Share {
    std::uint64_t faces = 0;
    std::uint64_t in_double = 0;
    std::uint64_t exact = 0;

    void add(const FacingStats& stats) {
        faces += stats.faces;
        in_double += stats.double_tests;
        exact += stats.exact_tests;
    }
    [[nodiscard]] double percent(std::uint64_t part) const {
        return 100.0 * static_cast<double>(part) /
               static_cast<double>(std::max<std::uint64_t>(faces, 1));
    }
};

struct Row {
    Share anywhere;    // points and suns in random directions
    Share on_purpose;  // points on vertices, suns along axes and edges
};

// Adds one mesh, moved by `offset` of its radii.
void measure(const test::Triangles& triangles, double offset, test::Random& random, Row& row) {
    const auto at_home = test::build(triangles);
    const glm::dvec3 low(at_home->bounds_min());
    const double radius = 0.5 * glm::length(glm::dvec3(at_home->bounds_max()) - low);
    test::Triangles moved = triangles;
    const glm::dvec3 by = random.unit_vector() * offset * radius;
    for (glm::vec3& p : moved.positions) p = glm::vec3(glm::dvec3(p) + by);
    const auto mesh = test::build(moved);
    const glm::dvec3 middle =
        0.5 * (glm::dvec3(mesh->bounds_min()) + glm::dvec3(mesh->bounds_max()));
    Facing facing;
    const auto test = [&](const glm::vec3& light, float w, Share& share) {
        classify_faces(*mesh, {glm::vec4(light, w)}, facing);
        share.add(facing.stats);
    };
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 away = random.unit_vector();
        test(glm::vec3(middle + away * radius * random.uniform(1.5, 6.0)), 1.0F, row.anywhere);
        test(glm::vec3(away), 0.0F, row.anywhere);
        const auto& [a, b, c] = mesh->faces()[random.below(mesh->faces().size())];
        test(mesh->positions()[a], 1.0F, row.on_purpose);
        test(mesh->positions()[b] - mesh->positions()[c], 0.0F, row.on_purpose);
        glm::vec3 axis(0.0F);
        axis[i % 3] = 1.0F;
        test(axis, 0.0F, row.on_purpose);
    }
}

TEST(FacingStages, SinglePrecisionIsEnoughForNearlyAllFacesOfRealModels) {
    if (!std::filesystem::exists(gnomon::test::models_folder())) {
        GTEST_SKIP() << "no models in " << gnomon::test::models_folder();
    }
    GNOMON_RANDOM(random);
    std::printf(
        "| model | triangles | offset / radius | anywhere: double | exact | on purpose: "
        "double | exact |\n|---|--:|--:|--:|--:|--:|--:|\n");
    for (const char* name :
         {"large/bunny-144k.glb", "props/flight-helmet.glb", "scenes/linz-old-town.glb",
          "scenes/dream-apartment.glb", "scenes/tall-building.glb", "hard/hard-degenerates.glb",
          "hard/hard-needle.glb"}) {
        const auto scene = scene::load_gltf(gnomon::test::models_folder() / name);
        if (!scene) {
            std::printf("%s\n", scene.error().message.c_str());
            continue;
        }
        std::set<std::shared_ptr<const scene::Mesh>> meshes;
        scene->registry.each<scene::MeshInstance>(
            [&](scene::Entity, const scene::MeshInstance& instance) {
                meshes.insert(instance.mesh);
            });
        for (const double offset : {0.0, 1e1, 1e3, 1e5}) {
            Row row;
            std::size_t count = 0;
            for (const auto& mesh : meshes) {
                if (mesh->triangle_count() == 0) continue;
                count += mesh->triangle_count();
                measure({mesh->positions, mesh->indices}, offset, random, row);
            }
            std::printf("| %s | %zu | %g | %.4f %% | %.4f %% | %.4f %% | %.4f %% |\n",
                        std::filesystem::path(name).stem().c_str(), count, offset,
                        row.anywhere.percent(row.anywhere.in_double),
                        row.anywhere.percent(row.anywhere.exact),
                        row.on_purpose.percent(row.on_purpose.in_double),
                        row.on_purpose.percent(row.on_purpose.exact));
            if (std::string(name).starts_with("hard/")) continue;  // slivers, on purpose
            EXPECT_LT(row.anywhere.percent(row.anywhere.in_double), 0.2) << name << " " << offset;
            EXPECT_LT(row.anywhere.percent(row.anywhere.exact), 0.05) << name << " " << offset;
        }
    }
}

}  // namespace
}  // namespace gnomon::shadows
