// SPDX-License-Identifier: MIT
//
// The table of techniques, and those parts of them that work without a device.
#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/shadows/silhouette.hpp>

#include "internal/baselines.hpp"
#include "internal/technique.hpp"
#include "internal/volumes.hpp"
#include "tests/report/subjects.hpp"

namespace gnomon::report::internal {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(Techniques, HaveNamesOfTheirOwnAndAutoIsFirst) {
    const std::vector<Entry> all = all_techniques();
    std::set<std::string> names;
    for (const Entry& entry : all) {
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
        EXPECT_TRUE(entry.summary.ends_with('.')) << entry.summary;
    }
    EXPECT_EQ(all[0].name, "auto");
    EXPECT_EQ(technique_names().size(), all.size());
    for (const std::string& name : technique_names(true)) EXPECT_TRUE(names.contains(name));
    EXPECT_LT(technique_names(true).size(), all.size() / 2);
    for (const shadows::SilhouetteStrategy& strategy : shadows::silhouette_strategies()) {
        EXPECT_THAT(technique_names(), Contains("silhouette " + std::string(strategy.name)));
    }
}

TEST(MainPlane, IsWhereMostAreaIs) {
    Subject subject = test::torus_over_floor();
    const auto plane = main_plane(subject.scene, {2.2, 4.2, 4.0});
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->y, 1.0, 1e-9);
    EXPECT_NEAR(plane->w, 0.0, 1e-9);
    // A larger wall, seen from its other side than it was made for.
    test::add(subject.scene, "wall", scene::make_box({0.5F, 20.0F, 20.0F}), {-5.0, 0.0, 0.0});
    scene::update_world_transforms(subject.scene.registry);
    const auto wall = main_plane(subject.scene, {2.2, 4.2, 4.0});
    ASSERT_TRUE(wall);
    EXPECT_NEAR(std::abs(wall->x), 1.0, 1e-9);
    EXPECT_GT(glm::dot(*wall, glm::dvec4(2.2, 4.2, 4.0, 1.0)), 0.0);
    EXPECT_FALSE(main_plane(scene::Scene{}, {0.0, 0.0, 0.0}));
}

TEST(Proxies, HaveAboutTheShareThatIsAskedFor) {
    const Subject subject = test::torus_over_floor();
    const auto casters = simplified_casters(subject.scene, 0.25, false);
    if (!can_simplify()) {
        ASSERT_FALSE(casters);
        EXPECT_EQ(casters.error().code, ErrorCode::Unsupported);
        EXPECT_THAT(casters.error().message, HasSubstr("meshoptimizer"));
        GTEST_SKIP() << casters.error().message;
    }
    ASSERT_TRUE(casters) << casters.error().message;
    ASSERT_EQ(casters->size(), 3U);
    for (const shadows::Caster& caster : *casters) {
        EXPECT_FALSE(caster.in_depth_buffer);
        const std::size_t triangles = caster.mesh->faces().size();
        if (triangles <= 12) continue;  // floor and box have no fewer
        EXPECT_NEAR(static_cast<double>(triangles), 48.0 * 24.0 * 2.0 * 0.25, 60.0);
        EXPECT_EQ(caster.mesh->report().closed_components, 1U);  // no seam was torn open
    }

    // Drawn in, the torus's bounds are smaller; what was not simplified is as it was.
    const auto inset = simplified_casters(subject.scene, 0.25, true);
    ASSERT_TRUE(inset) << inset.error().message;
    for (std::size_t i = 0; i < casters->size(); ++i) {
        const float before = (*casters)[i].mesh->bounds_max().x;
        const float after = (*inset)[i].mesh->bounds_max().x;
        if ((*casters)[i].mesh->faces().size() > 12) {
            EXPECT_LT(after, before);
            EXPECT_GT(after, 0.8F * before);
        } else {
            EXPECT_EQ(after, before);
        }
    }
}

}  // namespace
}  // namespace gnomon::report::internal
