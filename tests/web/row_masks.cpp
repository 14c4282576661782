// SPDX-License-Identifier: MIT
#include "tests/web/row_masks.hpp"

#include <fstream>
#include <map>
#include <memory>
#include <set>

#include "tests/rows/picture.hpp"

namespace gnomon::test {

namespace {

constexpr std::string_view head = "gnomon row masks 2\n";
constexpr std::uint32_t most = 64U << 20U;  // bytes of anything in such a file

void put(std::ostream& out, std::uint32_t value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class Values>
void put_all(std::ostream& out, const Values& values) {
    put(out, static_cast<std::uint32_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof values[0]));
}

std::uint32_t get(std::istream& in) {
    std::uint32_t value = 0;
    in.read(reinterpret_cast<char*>(&value), sizeof value);
    return in && value <= most ? value : 0;
}
template <class Values>
void get_all(std::istream& in, Values& values) {
    values.resize(get(in));
    in.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof values[0]));
}

using MeshPointer = std::shared_ptr<const scene::Mesh>;

// In the same order each time.
template <class Visit>
void visit_poses(Setting& setting, Visit visit) {
    setting.scene.registry.each<scene::WorldTransform>(
        [&](scene::Entity, scene::WorldTransform& world) { visit(world.world_from_local); });
    visit(setting.view.view_from_world);
    visit(setting.view.clip_from_view);
}

}  // namespace

Setting setting_as_drawn(const Row& row, const RowMasks& drawn) {
    Setting setting = row.make();
    std::size_t next = 0;
    visit_poses(setting, [&](glm::dmat4& pose) {
        for (int i = 0; i < 16; ++i) pose[i / 4][i % 4] = drawn.poses.at(next++);
    });
    std::map<const scene::Mesh*, MeshPointer> replaced;
    std::size_t mesh_number = 0;
    setting.scene.registry.each<scene::MeshInstance>(
        [&](scene::Entity, scene::MeshInstance& instance) {
            MeshPointer& mesh = replaced[instance.mesh.get()];
            if (!mesh) {
                auto copy = std::make_shared<scene::Mesh>(*instance.mesh);
                copy->positions = drawn.vertices.at(mesh_number++);
                copy->normals = drawn.vertices.at(mesh_number++);
                mesh = std::move(copy);
            }
            instance.mesh = mesh;
        });
    return setting;
}

Result<RowMasks> draw_setting(gpu::Device& device, const Row& row, Setting setting,
                              std::uint32_t samples) {
    RowMasks drawn;
    drawn.row = row.name;
    drawn.samples = samples;
    visit_poses(setting, [&](glm::dmat4& pose) {
        drawn.poses.insert(drawn.poses.end(), &pose[0][0], &pose[0][0] + 16);
    });
    std::set<const scene::Mesh*> seen;
    setting.scene.registry.each<scene::MeshInstance>(
        [&](scene::Entity, const scene::MeshInstance& instance) {
            if (!seen.insert(instance.mesh.get()).second) return;
            drawn.vertices.push_back(instance.mesh->positions);
            drawn.vertices.push_back(instance.mesh->normals);
        });
    auto picture =
        take_picture(device, setting, {.samples = samples, .cull_back_faces = row.cull_back_faces});
    if (!picture) return forward_error(picture);
    drawn.masks = std::move(picture->masks);
    drawn.depth = std::move(picture->depth);
    return drawn;
}

Status write_masks(const std::filesystem::path& path, const std::vector<RowMasks>& all) {
    std::ofstream file(path, std::ios::binary);
    file << head;
    put(file, static_cast<std::uint32_t>(all.size()));
    for (const RowMasks& row : all) {
        put_all(file, row.row);
        put(file, row.samples);
        put_all(file, row.poses);
        put(file, static_cast<std::uint32_t>(row.vertices.size()));
        for (const auto& vertices : row.vertices) put_all(file, vertices);
        put_all(file, row.depth);
        put(file, static_cast<std::uint32_t>(row.masks.size()));
        for (const auto& light : row.masks) {
            for (const auto& sample : light) put_all(file, sample);
        }
    }
    if (!file.flush()) return fail(ErrorCode::Io, path.string() + " could not be written.");
    return {};
}

Result<std::vector<RowMasks>> read_masks(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string first(head.size(), '\0');
    file.read(first.data(), static_cast<std::streamsize>(first.size()));
    if (first != head) return fail(ErrorCode::Io, path.string() + " is no file of row masks.");
    std::vector<RowMasks> all(get(file));
    for (RowMasks& row : all) {
        get_all(file, row.row);
        row.samples = get(file);
        get_all(file, row.poses);
        row.vertices.resize(get(file));
        for (auto& vertices : row.vertices) get_all(file, vertices);
        get_all(file, row.depth);
        row.masks.resize(get(file));
        for (auto& light : row.masks) {
            for (std::uint32_t i = 0; i < row.samples; ++i) {
                get_all(file, light.emplace_back());
            }
        }
        if (!file) return fail(ErrorCode::Io, path.string() + " ends too early.");
    }
    return all;
}

}  // namespace gnomon::test
