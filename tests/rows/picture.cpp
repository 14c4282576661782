// SPDX-License-Identifier: MIT
#include "tests/rows/picture.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>

#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/support/paths.hpp"

namespace gnomon::test {

namespace {

std::vector<std::uint8_t> as_uint8(const std::vector<std::byte>& bytes) {
    std::vector<std::uint8_t> result(bytes.size());
    std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
}

void save_pgm(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> values) {
    std::ofstream file(path, std::ios::binary);
    file << "P5\n" << width << ' ' << height << "\n255\n";
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size()));
}

std::vector<shadows::Light> lights_of(const scene::Scene& scene) {
    std::vector<shadows::Light> lights;
    const auto add = [&](scene::Entity entity, const auto&) {
        if (const auto light = scene::shadow_light(scene.registry, entity)) {
            lights.push_back(*light);
        }
    };
    scene.registry.each<scene::PointLight>(add);
    scene.registry.each<scene::SpotLight>(add);
    scene.registry.each<scene::DirectionalLight>(add);
    return lights;
}

}  // namespace

Result<Picture> take_picture(gpu::Device& device, const Setting& setting,
                             const PictureOptions& options) {
    auto renderer =
        render::Renderer::create(device, {.width = options.width,
                                          .height = options.height,
                                          .sample_count = options.samples,
                                          .depth_stencil_format = options.depth_stencil_format,
                                          .extrusion = options.extrusion,
                                          .volume_depth_compare = options.volume_depth_compare,
                                          .averted_faces = options.averted_faces,
                                          .cull_back_faces = options.cull_back_faces});
    if (!renderer) return forward_error(renderer);
    if (const Status uploaded = renderer->upload(setting.scene); !uploaded)
        return forward_error(uploaded);
    auto system = shadows::ShadowSystem::create({.force_technique = options.technique,
                                                 .silhouette = options.silhouette,
                                                 .max_layers = options.max_layers,
                                                 .layer_bound = options.layer_bound,
                                                 .caps = options.caps,
                                                 .receivers = options.receivers,
                                                 .fill = options.fill});
    if (!system) return forward_error(system);
    scene::ShadowAdapter adapter;
    for (int left = options.approach_frames; left > 0; --left) {
        auto before = system->begin_frame();
        const Status told =
            adapter.submit(setting.scene, before, options.cull_back_faces, options.near_caps);
        if (!told) return forward_error(told);
        for (shadows::Light light : lights_of(setting.scene)) {
            light.position_world += 0.004 * left * glm::dvec4(1.0, 0.5, -0.7, 0.0);
            before.light(light);
        }
        static_cast<void>(std::move(before).finish(setting.view));
    }
    auto frame = system->begin_frame();
    const Status submitted =
        adapter.submit(setting.scene, frame, options.cull_back_faces, options.near_caps);
    if (!submitted) return forward_error(submitted);

    Picture picture;
    picture.list = std::move(frame).finish(setting.view);
    if (options.mutate) options.mutate(picture.list);
    const auto after_light = [&](std::size_t) -> Status {
        picture.masks.emplace_back();
        for (std::uint32_t sample = 0; sample < options.samples; ++sample) {
            auto counts = render::read_stencil(device, *renderer, sample);
            if (!counts) return forward_error(counts);
            picture.masks.back().push_back(as_uint8(*counts));
        }
        return {};
    };
    const Status rendered =
        renderer->render({setting.scene, setting.view, picture.list, after_light});
    if (!rendered) return forward_error(rendered);
    if (options.samples == 1) {
        auto depth = device.read_texture(renderer->depth_stencil(), gpu::Aspect::DepthOnly);
        if (!depth) return forward_error(depth);
        picture.depth = as_uint8(*depth);
    }
    return picture;
}

std::size_t differing_bytes(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
    std::size_t count = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

std::string save_difference(const std::string& name, std::uint32_t width, std::uint32_t height,
                            std::span<const std::uint8_t> actual,
                            std::span<const std::uint8_t> expected) {
    const std::filesystem::path folder = output_folder();
    std::filesystem::create_directories(folder);
    std::vector<std::uint8_t> difference(actual.size());
    for (std::size_t i = 0; i < std::min(actual.size(), expected.size()); ++i) {
        difference[i] = actual[i] == expected[i] ? 0 : 255;
    }
    save_pgm(folder / (name + ".actual.pgm"), width, height, actual);
    save_pgm(folder / (name + ".expected.pgm"), width, height, expected);
    save_pgm(folder / (name + ".difference.pgm"), width, height, difference);
    return (folder / (name + ".{actual,expected,difference}.pgm")).string();
}

}  // namespace gnomon::test
