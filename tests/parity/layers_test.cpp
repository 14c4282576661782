// SPDX-License-Identifier: MIT
//
// More layers than a stencil counts: shells, sheets and casters piled up to a thousand, on every
// device and stencil path, at one and at four samples, by depth-pass and by depth-fail. A pile
// casts the shadow of its widest layer, so one layer alone is what a mask must equal. And ordinary
// scenes, cut into small batches on purpose, keep their masks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"

namespace gnomon::test {
namespace {

using shadows::Technique;

constexpr std::uint32_t width = 96;
constexpr std::uint32_t height = 72;

// Copies of a mesh in one: each scaled by its own factor and lifted.
template <class Place>
scene::Mesh pile(const scene::Mesh& layer, int count, Place place) {
    scene::Mesh mesh;
    mesh.name = "pile";
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : layer.positions) mesh.positions.push_back(place(p, i));
        for (const std::uint32_t index : layer.indices) mesh.indices.push_back(first + index);
        mesh.normals.insert(mesh.normals.end(), layer.normals.begin(), layer.normals.end());
    }
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return mesh;
}

// The layers that lie within the outermost one do not show.
glm::vec3 nested(const glm::vec3& p, int i) { return p * (1.0F - 0.0005F * static_cast<float>(i)); }

struct Heap {
    std::string name;
    std::vector<scene::Mesh> meshes;
};

// Shells within each other: one mesh each, and all in one mesh.
Heap shells_apart(int count) {
    Heap heap{"shells_apart", {}};
    for (int i = 0; i < count; ++i) {
        heap.meshes.push_back(pile(scene::make_box(glm::vec3(1.0F)), 1,
                                   [&](const glm::vec3& p, int) { return nested(p, i); }));
    }
    return heap;
}
Heap shells_in_one(int count) {
    return {"shells_in_one", {pile(scene::make_sphere(0.7F, 12, 8), count, nested)}};
}
// How much smaller and lower each layer of the next two is than the one before it: so that the
// uppermost one hides the others from both lights.
constexpr float shrinking = 1e-4F;

// A cloth folded over and over: one open component, two-sided, every fold a silhouette.
Heap folded(int count) {
    scene::Mesh mesh;
    mesh.name = "folded";
    for (int i = 0; i <= count; ++i) {
        const float in = shrinking * static_cast<float>(i);
        const float x = i % 2 == 0 ? in - 0.6F : 0.6F - in;
        for (const float z : {in - 0.5F, 0.5F - in}) {
            mesh.positions.emplace_back(x, -in, z);
            mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
        }
        const auto v = static_cast<std::uint32_t>(2 * i);
        if (i > 0) mesh.indices.insert(mesh.indices.end(), {v - 2, v - 1, v, v - 1, v + 1, v});
    }
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return {"folded", {mesh}};
}

// A winding stair, `count` turns of it: one component, all of which faces the light.
Heap stair(int count) {
    constexpr int steps = 12;
    scene::Mesh mesh;
    mesh.name = "stair";
    for (int i = 0; i <= std::max(count, 2) * steps; ++i) {
        const double angle = 6.283185307179586 * (i % steps) / steps;
        const double in = static_cast<double>(shrinking) * i / steps;
        for (const double r : {0.2 + in, 0.8 - in}) {
            mesh.positions.emplace_back(r * std::cos(angle), -in, r * std::sin(angle));
            mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
        }
        const auto v = static_cast<std::uint32_t>(2 * i);
        if (i > 0) mesh.indices.insert(mesh.indices.end(), {v - 2, v, v - 1, v - 1, v, v + 1});
    }
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return {"stair", {mesh}};
}

// Over a ground, hung up and not drawn, so that the ground is all that is seen.
Setting setting_of(const Heap& heap) {
    Setting setting;
    scene::Scene& scene = setting.scene;
    scene.materials.emplace_back();
    const auto add = [&](scene::Mesh mesh, const glm::dvec3& at, bool casts) {
        scene::LocalTransform local;
        local.translation = at;
        const scene::Entity node = scene.create_node(mesh.name, local);
        scene.registry.emplace<scene::MeshInstance>(
            node, std::make_shared<const scene::Mesh>(std::move(mesh)));
        if (casts) scene.registry.emplace<scene::Caster>(node);
        if (!casts) scene.registry.emplace<scene::Receiver>(node);
    };
    add(scene::make_plane(20.0F, 20.0F, 4), {0, 0, 0}, false);
    for (const scene::Mesh& mesh : heap.meshes) add(mesh, {0.1, 1.5, 0.05}, true);
    scene::LocalTransform lamp;
    lamp.translation = {0.7, 5.0, 0.4};
    scene.registry.emplace<scene::PointLight>(scene.create_node("lamp", lamp));
    scene::LocalTransform sun;
    sun.matrix = glm::inverse(
        shadows::look_at(glm::dvec3(0.0), glm::dvec3(-0.3, -1.0, -0.2), {0.123, 1.0, 0.456}));
    scene.registry.emplace<scene::DirectionalLight>(scene.create_node("sun", sun));
    scene::update_world_transforms(scene.registry);
    setting.view = {shadows::look_at({0.5, 3.5, 4.5}, {0, 0.2, 0}, {0, 1, 0}),
                    shadows::infinite_perspective(0.8, static_cast<double>(width) / height, 0.01)};
    return setting;
}

std::vector<std::uint8_t> as_mask(std::vector<std::uint8_t> bytes) {
    for (std::uint8_t& byte : bytes) byte = byte != 0 ? 255 : 0;
    return bytes;
}

std::size_t count_of(const std::vector<std::uint8_t>& bytes, std::uint8_t value) {
    return static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), value));
}

class Layers : public DeviceTest {
protected:
    Picture take(const Setting& setting, std::uint32_t samples, Technique technique) {
        return must(take_picture(device(), setting,
                                 {.width = width,
                                  .height = height,
                                  .samples = samples,
                                  .technique = technique,
                                  .fill = {.cull_by_umbra = false}}));
    }

    // `make(1)` is the shape of the pile's shadow.
    void expect_one_shadow(Heap (*make)(int), const std::vector<int>& counts) {
        std::size_t combination = 0;
        for (const std::uint32_t samples : {1U, 4U}) {
            for (const Technique technique : {Technique::DepthPass, Technique::DepthFail}) {
                // Of two devices next to each other one takes the first and the last.
                if (!falls_to(number(), (combination++ + 1) / 2, 2)) continue;
                const Picture one = take(setting_of(make(1)), samples, technique);
                for (const int count : counts) {
                    const Heap heap = make(count);
                    SCOPED_TRACE(fmt::format(
                        "{} {}, {} samples, {}", count, heap.name, samples,
                        technique == Technique::DepthPass ? "depth-pass" : "depth-fail"));
                    expect_equal(take(setting_of(heap), samples, technique), one, count);
                }
            }
        }
    }

    void expect_equal(const Picture& many, const Picture& one, int count) {
        ASSERT_EQ(many.masks.size(), one.masks.size());
        for (std::size_t light = 0; light < one.masks.size(); ++light) {
            const bool split = many.list.lights[light].batches > 1;
            EXPECT_EQ(split, count > 255);
            for (std::size_t sample = 0; sample < one.masks[light].size(); ++sample) {
                const auto expected = as_mask(one.masks[light][sample]);
                const auto& actual = many.masks[light][sample];
                EXPECT_GT(count_of(expected, 255), 100U);
                EXPECT_GT(count_of(expected, 0), 100U);
                EXPECT_EQ(differing_bytes(as_mask(actual), expected), 0U)
                    << "light " << light << " sample " << sample << " "
                    << save_difference("layers", width, height, as_mask(actual), expected);
                if (split) {
                    EXPECT_EQ(count_of(actual, 0) + count_of(actual, 255), actual.size());
                } else {
                    const int most = *std::max_element(actual.begin(), actual.end());
                    EXPECT_GE(most, count) << "raw counts where nothing is split";
                    EXPECT_LE(most, count + 1) << "where a stair's turn begins there are two";
                }
            }
        }
    }
};

TEST_P(Layers, shells_in_meshes_of_their_own_cast_one_shadow) {
    expect_one_shadow(shells_apart, {127, 128, 255, 256, 257});
}

TEST_P(Layers, shells_in_one_mesh_cast_one_shadow) {
    expect_one_shadow(shells_in_one, {255, 256, 257, 1000});
}

TEST_P(Layers, one_folded_sheet_casts_one_shadow) {
    expect_one_shadow(folded, {255, 256, 257, 1000});
}

// One patch that lies over itself: cuts run through the middle of it.
TEST_P(Layers, one_winding_stair_casts_one_shadow) { expect_one_shadow(stair, {240, 257}); }

INSTANTIATE_TEST_SUITE_P(Devices, Layers, testing::ValuesIn(drawing_devices()), device_case_name);

// Ordinary scenes are not split; split on purpose, they keep their light and dark.
class SplitRow : public testing::TestWithParam<Row> {
protected:
    static std::uint64_t sides_of(const Picture& picture, std::size_t light) {
        const shadows::LightDraws& draws = picture.list.lights[light];
        std::uint64_t sides = 0;
        for (std::uint32_t i = draws.first; i < draws.first + draws.count; ++i)
            sides += picture.list.draws[i].volume->sides.count;
        return sides;
    }

    // On one of every two devices, another one for the next row.
    static void compare_on_some(std::size_t first, std::uint32_t limit, std::uint32_t samples) {
        const auto row = std::ranges::find(rows(), GetParam().name, &Row::name) - rows().begin();
        const std::vector<DeviceCase> devices = drawing_devices();
        for (std::size_t d = 0; d < devices.size(); ++d) {
            if (falls_to(d, first + static_cast<std::size_t>(row), 2)) {
                compare(devices[d], limit, samples);
            }
        }
    }

    // Masks of the row in batches of a few layers against those of the row as it is.
    static void compare(const DeviceCase& device_case, std::uint32_t limit, std::uint32_t samples) {
        const auto device = shared_device(device_case);
        if (!device) return;
        const Setting setting = GetParam().make();
        PictureOptions options{.samples = samples, .cull_back_faces = GetParam().cull_back_faces};
        const Picture whole = must(take_picture((*device)->device, setting, options));
        EXPECT_EQ(whole.list.stats.split_lights, 0U) << "an ordinary scene";
        options.max_layers = limit;
        const Picture split = must(take_picture((*device)->device, setting, options));
        if (limit <= 2) {
            EXPECT_GT(split.list.stats.split_lights, 0U);
        }
        for (std::size_t light = 0; light < whole.masks.size(); ++light) {
            // At a shadow's very edge rounding may add to one patch's count what it takes from
            // another's; then the sum hides what the parts show. And where a patch had to be cut in
            // the middle, sides stand on a surface that is lit on both sides of the cut
            // (docs/numerics.md, "Layers").
            const bool cut = sides_of(split, light) > sides_of(whole, light);
            for (std::size_t sample = 0; sample < samples; ++sample) {
                const auto actual = as_mask(split.masks[light][sample]);
                const auto expected = as_mask(whole.masks[light][sample]);
                const std::size_t wrong = differing_bytes(actual, expected);
                if (wrong > 0) {
                    std::printf("%-20s %-36s light %zu sample %zu: %zu bytes differ, %s\n",
                                device_case.name.c_str(), GetParam().name.c_str(), light, sample,
                                wrong, cut ? "patches are cut" : "no patch is cut");
                }
                EXPECT_LE(wrong, cut ? 8U : 1U)
                    << device_case.name << ", light " << light << " in "
                    << split.list.lights[light].batches << " batches, sample " << sample << ": "
                    << save_difference(fmt::format("split.{}", GetParam().name), row_width,
                                       row_height, actual, expected);
            }
        }
    }
};

TEST_P(SplitRow, batches_of_a_few_layers_give_the_same_mask) { compare_on_some(0, 8, 4); }

TEST_P(SplitRow, batches_of_two_layers_give_the_same_mask) { compare_on_some(1, 2, 1); }

INSTANTIATE_TEST_SUITE_P(Rows, SplitRow, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gnomon::test
