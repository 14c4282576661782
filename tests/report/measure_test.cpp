// SPDX-License-Identifier: MIT
//
// A whole measurement on every device that draws: what claims to be exact has no wrong pixel, what
// does not is caught, and the same figures come out twice.
#include <gnomon/report/report.hpp>

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <gnomon/gpu/fault_backend.hpp>
#include <gnomon/gpu/null_backend.hpp>
#include <gnomon/report/writers.hpp>

#include "internal/technique.hpp"
#include "tests/report/subjects.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::report::test {
namespace {

using testing::HasSubstr;

std::vector<std::string> names_of(const std::vector<std::string>& families) {
    std::vector<std::string> names;
    for (const internal::Entry& entry : internal::all_techniques()) {
        if (std::ranges::find(families, entry.family) != families.end()) {
            names.push_back(entry.name);
        }
    }
    return names;
}

const Row& row_of(const Cell& cell, std::string_view technique) {
    const auto found = std::ranges::find(cell.rows, technique, &Row::technique);
    if (found == cell.rows.end()) throw std::runtime_error("no such row");
    return *found;
}

// All that does not depend on the clock.
nlohmann::json errors_in(const Cell& cell) {
    auto json = nlohmann::json::parse(cell_to_json(cell));
    json.erase("empty_frame_ms");
    for (auto& row : json.at("rows")) {
        for (const char* clock :
             {"frame_ms", "detect_ms", "build_ms", "record_ms", "against_auto"}) {
            row.erase(clock);
        }
    }
    return json;
}

class Measure : public gnomon::test::DeviceTest {
protected:
    Cell measured(const std::vector<std::string>& only, Options options = small_options()) {
        options.only = only;
        Subject subject = torus_over_floor();
        return gnomon::test::must(measure(device(), subject, options));
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, Measure, testing::ValuesIn(gnomon::test::drawing_devices()),
                         gnomon::test::device_case_name);

TEST_P(Measure, WhatIsExactHasNoWrongPixel) {
    const Cell cell = measured(names_of({"volumes", "projection", "silhouettes", "rays"}));
    EXPECT_GT(cell.rows.size(), 15U);
    std::size_t drawn = 0;
    for (const Row& row : cell.rows) {
        // Its near plane cuts into this scene.
        if (!row.skipped.empty() || row.technique.ends_with("near x100")) continue;
        ++drawn;
        EXPECT_EQ(row.errors.wrong_worst, 0U) << row.technique;
        EXPECT_GT(row.errors.iou_worst, 0.97) << row.technique;
        EXPECT_GT(row.frame_ms.median, 0.0) << row.technique;
        EXPECT_FALSE(row.mask.png.empty()) << row.technique;
    }
    EXPECT_GT(drawn, 12U);
    EXPECT_EQ(cell.rows[0].technique, "auto");
    EXPECT_EQ(row_of(cell, "auto").layers, 2U);  // the tube's and the box's
    EXPECT_EQ(cell.triangles, 2U + 48U * 24U * 2U + 12U);
    EXPECT_EQ(cell.casters, 3U);
    EXPECT_EQ(cell.lights, 1U);
}

TEST_P(Measure, MapsAreWrongAndLessSoWhenTheyAreLarger) {
    const Cell cell = measured({"shadow map, sloped 512", "shadow map, sloped 2048"});
    const Row& small = row_of(cell, "shadow map, sloped 512");
    const Row& large = row_of(cell, "shadow map, sloped 2048");
    ASSERT_EQ(small.skipped, "");
    ASSERT_EQ(large.skipped, "");
    EXPECT_GT(small.errors.wrong_at_all_median, large.errors.wrong_at_all_median);
    // Edges alone: a map without acne and without a gap below the casters.
    EXPECT_GT(small.errors.iou_worst, 0.97);
    EXPECT_GT(large.errors.iou_worst, small.errors.iou_worst);
}

TEST_P(Measure, FlattenedCastersShadowTheFloorAlone) {
    const Cell cell = measured({"planar"});
    const Row& planar = row_of(cell, "planar");
    ASSERT_EQ(planar.skipped, "");
    EXPECT_GT(planar.errors.false_light_worst, 0U);   // on the box
    EXPECT_LE(planar.errors.false_shadow_worst, 2U);  // drawn on the floor, of what is above it
    EXPECT_GT(planar.errors.iou_worst, 0.5);
}

TEST_P(Measure, TheSameFiguresComeOutTwice) {
    const std::vector<std::string> some{"depth-fail", "shadow map, 3x3 512", "planar",
                                        "silhouette every 2 frames", "proxies 25 %, inset"};
    EXPECT_EQ(errors_in(measured(some)), errors_in(measured(some)));
}

TEST_P(Measure, ShortFramesGetMoreRounds) {
    Options options = small_options();
    options.only = {"depth-fail"};
    Subject subject = torus_over_floor();
    const Cell few = gnomon::test::must(measure(device(), subject, options));
    EXPECT_EQ(few.rounds, 1U);
    options.least_seconds = 1e9;  // never enough, but there is an end
    const Cell many = gnomon::test::must(measure(device(), subject, options));
    EXPECT_EQ(many.rounds, 10U);
    EXPECT_EQ(few.rows[0].errors.wrong_at_all_worst, many.rows[0].errors.wrong_at_all_worst);
    options.least_seconds = 1e-9;  // the rounds that were asked for are enough
    EXPECT_EQ(gnomon::test::must(measure(device(), subject, options)).rounds, 1U);
    for (const Cell* cell : {&few, &many}) {
        EXPECT_GT(cell->empty_frame_ms, 0.0);
        EXPECT_LT(cell->empty_frame_ms, row_of(*cell, "auto").frame_ms.high);
    }
}

TEST_P(Measure, LightsAreLeftAsTheyWere) {
    Subject subject = torus_over_floor();
    const auto lights = [&] {
        std::vector<glm::dmat4> poses;
        subject.scene.registry.each<scene::PointLight, scene::WorldTransform>(
            [&](scene::Entity, const scene::PointLight&, const scene::WorldTransform& world) {
                poses.push_back(world.world_from_local);
            });
        return poses;
    };
    const auto before = lights();
    Options options = small_options();
    options.only = {"depth-fail"};
    double last = 0.0;
    gnomon::test::must(measure(device(), subject, options, [&](const Progress& progress) {
        EXPECT_GE(progress.done, last);
        EXPECT_LE(progress.done, 1.0);
        last = progress.done;
    }));
    EXPECT_NEAR(last, 1.0, 1e-9);
    EXPECT_EQ(lights(), before);
}

TEST_P(Measure, WhatCannotBeMeasuredIsSaid) {
    const auto refusal = [&](Subject subject) {
        const auto cell = measure(device(), subject, small_options());
        return cell ? std::string("measured") : cell.error().message;
    };
    Subject dark = torus_over_floor();
    keep_lights(dark, small_options(), 0);
    EXPECT_THAT(refusal(std::move(dark)), HasSubstr("made by a test: there is no light"));
    Subject flat = torus_over_floor();
    flat.camera.projection = scene::OrthographicCamera{};
    EXPECT_THAT(refusal(std::move(flat)), HasSubstr("the camera is orthographic"));
    Subject empty;
    empty.source = "nothing";
    const scene::Entity lamp = empty.scene.create_node("lamp");
    empty.scene.registry.emplace<scene::PointLight>(lamp);
    scene::update_world_transforms(empty.scene.registry);
    EXPECT_THAT(refusal(std::move(empty)), HasSubstr("there is nothing in the scene"));
}

// A cell without half of its techniques would be kept, and taken over ever after.
TEST(LostDevice, IsNoCell) {
    Options options = small_options();
    options.only = {"depth-fail", "planar"};
    Subject subject = torus_over_floor();
    gpu::FaultPlan plan;
    gpu::Device device(gpu::create_fault_backend(gpu::create_null_backend(), plan));
    ASSERT_TRUE(measure(device, subject, options));
    const std::size_t calls = plan.calls;
    for (const double when : {0.3, 0.5, 0.7, 0.9}) {
        plan = {.fail_at = static_cast<std::size_t>(when * static_cast<double>(calls)),
                .code = ErrorCode::DeviceLost};
        const auto cell = measure(device, subject, options);
        ASSERT_FALSE(cell) << when;
        EXPECT_EQ(cell.error().code, ErrorCode::DeviceLost) << when;
    }
    // Whatever else fails is a row that says so.
    plan = {.fail_at = calls / 2};
    const auto cell = measure(device, subject, options);
    ASSERT_TRUE(cell) << cell.error().message;
    EXPECT_EQ(
        std::ranges::count_if(cell->rows, [](const Row& row) { return !row.skipped.empty(); }), 1);
}

TEST(CellKey, ChangesWithWhatDeterminesACell) {
    const Subject subject = torus_over_floor();
    const Options options = small_options();
    const machine::Machine here{.processor = "a processor", .cores = 2, .system = "a system"};
    const std::string key = cell_key(subject, options, here, "gl", "an adapter");
    EXPECT_EQ(key.size(), 16U);
    EXPECT_EQ(cell_key(torus_over_floor(), options, here, "gl", "an adapter"), key);
    EXPECT_NE(cell_key(subject, options, here, "vk", "an adapter"), key);
    EXPECT_NE(cell_key(subject, options, here, "gl", "another"), key);
    Options other = options;
    other.rounds = 2;
    EXPECT_NE(cell_key(subject, other, here, "gl", "an adapter"), key);
    // Another commit, another build of it, and any other machine.
    for (const machine::Machine& elsewhere :
         {machine::Machine{.processor = "another", .cores = 2, .system = "a system"},
          machine::Machine{.processor = "a processor", .cores = 16, .system = "a system"},
          machine::Machine{.processor = "a processor", .cores = 2, .system = "another"}}) {
        EXPECT_NE(cell_key(subject, options, elsewhere, "gl", "an adapter"), key);
    }
    other = options;
    other.build = "another";
    EXPECT_NE(cell_key(subject, other, here, "gl", "an adapter"), key);
    other = options;
    other.least_seconds = 1.0;
    EXPECT_NE(cell_key(subject, other, here, "gl", "an adapter"), key);
    other = options;
    other.version = "next";
    EXPECT_NE(cell_key(subject, other, here, "gl", "an adapter"), key);
    Subject moved = torus_over_floor();
    moved.world_from_camera[3].x += 1e-9;
    EXPECT_NE(cell_key(moved, options, here, "gl", "an adapter"), key);
}

}  // namespace
}  // namespace gnomon::report::test
