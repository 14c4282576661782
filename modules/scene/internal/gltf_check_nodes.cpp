// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "internal/gltf_check.hpp"

namespace gnomon::scene::internal {
namespace {

constexpr double smallest = 1e-30;  // stands for "more than zero" where zero makes no sense

void check_camera(const JsonPlace& camera) {
    const std::string& type = camera.member("type").one_of({"perspective", "orthographic"});
    const JsonPlace projection = camera.member(type).object();
    if (type == "perspective") {
        static_cast<void>(projection.member("yfov").number(smallest, std::numbers::pi - 1e-6));
        static_cast<void>(projection.member("znear").number(smallest));
        for (const char* name : {"zfar", "aspectRatio"}) {
            if (const auto value = projection.find(name)) {
                static_cast<void>(value->number(smallest));
            }
        }
    } else {
        for (const char* name : {"xmag", "ymag"}) {
            const JsonPlace value = projection.member(name);
            if (value.number() == 0.0) value.must_be("a number other than zero");
        }
        const double near = projection.member("znear").number(0.0);
        if (projection.member("zfar").number() <= near) {
            projection.member("zfar").must_be(fmt::format("more than znear, which is {}", near));
        }
    }
}

void check_light(const JsonPlace& light) {
    const std::string& type = light.member("type").one_of({"point", "spot", "directional"});
    if (const auto color = light.find("color")) static_cast<void>(color->numbers(3, 0.0));
    if (const auto intensity = light.find("intensity")) static_cast<void>(intensity->number(0.0));
    if (const auto range = light.find("range")) static_cast<void>(range->number(smallest));
    if (type != "spot") return;
    const JsonPlace spot = light.member("spot").object();
    double inner = 0.0;
    double outer = std::numbers::pi / 4.0;
    // Files round the right angle up to their last digit.
    constexpr double widest = std::numbers::pi / 2.0 + 1e-6;
    if (const auto angle = spot.find("innerConeAngle")) inner = angle->number(0.0, widest);
    if (const auto angle = spot.find("outerConeAngle")) outer = angle->number(smallest, widest);
    if (inner > outer) {
        spot.refuse(
            fmt::format("has the inner cone angle {}, but it must be at most the outer "
                        "one, which is {}",
                        inner, outer));
    }
}

void check_skin(const JsonPlace& root, const JsonPlace& skin) {
    const JsonPlace joints = skin.member("joints").array();
    if (joints.size() == 0) joints.must_be("an array of at least one node");
    for (std::size_t i = 0; i < joints.size(); ++i) check_reference(root, joints.at(i), "nodes");
    if (const auto matrices = skin.find("inverseBindMatrices")) {
        const std::uint64_t count = check_accessor_kind(root, *matrices, "MAT4", {5126});
        if (count < joints.size()) {
            matrices->refuse(
                fmt::format("has {} matrices, but the skin has {} joints", count, joints.size()));
        }
    }
    if (const auto skeleton = skin.find("skeleton")) check_reference(root, *skeleton, "nodes");
}

void check_instancing(const JsonPlace& root, const JsonPlace& node) {
    const auto instancing = find_extension(node, "EXT_mesh_gpu_instancing");
    if (!instancing) return;
    const JsonPlace attributes = instancing->member("attributes").object();
    std::optional<std::uint64_t> count;
    const auto check = [&](const char* name, std::string_view type,
                           std::initializer_list<int> components) {
        const auto reference = attributes.find(name);
        if (!reference) return;
        const std::uint64_t its_count = check_accessor_kind(root, *reference, type, components);
        if (count && its_count != *count) {
            reference->refuse(
                fmt::format("has {} elements, but another attribute has {}", its_count, *count));
        }
        count = its_count;
    };
    check("TRANSLATION", "VEC3", {5126});
    check("ROTATION", "VEC4", {5126, 5120, 5122});
    check("SCALE", "VEC3", {5126});
    if (!count) {
        attributes.refuse(
            "has none of TRANSLATION, ROTATION and SCALE, so that the number of "
            "instances is unknown");
    }
}

void check_node(const JsonPlace& root, const JsonPlace& node) {
    for (const auto& [member, array] : {std::pair{"mesh", "meshes"}, std::pair{"camera", "cameras"},
                                        std::pair{"skin", "skins"}}) {
        if (const auto reference = node.find(member)) check_reference(root, *reference, array);
    }
    const auto matrix = node.find("matrix");
    if (matrix) {
        static_cast<void>(matrix->numbers(16));
        constexpr int row_3[] = {3, 7, 11, 15};
        for (const int i : row_3) {
            const JsonPlace entry = matrix->at(static_cast<std::size_t>(i));
            const double wanted = i == 15 ? 1.0 : 0.0;
            if (std::abs(entry.number() - wanted) > 1e-6) {
                entry.must_be(fmt::format("{}, since node matrices are affine", wanted));
            }
        }
    }
    for (const char* name : {"translation", "scale"}) {
        const auto value = node.find(name);
        if (!value) continue;
        static_cast<void>(value->numbers(3));
        if (matrix) value->refuse("stands beside a matrix, but only one of them may be there");
    }
    if (const auto rotation = node.find("rotation")) {
        double length = 0.0;
        for (const double part : rotation->numbers(4)) length += part * part;
        if (length < 1e-12) rotation->must_be("a quaternion of length 1");
        if (matrix) rotation->refuse("stands beside a matrix, but only one of them may be there");
    }
    if (const auto weights = node.find("weights")) {
        const auto mesh = node.find("mesh");
        if (mesh) {
            check_morph_weights(*weights, morph_target_count(root.member("meshes").at(
                                              check_reference(root, *mesh, "meshes"))));
        }
    }
    if (const auto light = find_extension(node, "KHR_lights_punctual")) {
        const auto lights = find_extension(root, "KHR_lights_punctual");
        if (!lights) light->refuse("names a light, but the file has no lights");
        check_reference(*lights, light->member("light"), "lights");
    }
    check_instancing(root, node);
}

/// A node has at most one parent and is never below itself.
void check_tree(const JsonPlace& root, const std::vector<JsonPlace>& nodes) {
    constexpr auto none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> parents(nodes.size(), none);
    std::vector<std::vector<std::size_t>> children(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto list = nodes[i].find("children");
        if (!list) continue;
        list->array();
        for (std::size_t k = 0; k < list->size(); ++k) {
            const std::size_t child = check_reference(root, list->at(k), "nodes");
            if (parents[child] != none) {
                list->at(k).refuse(fmt::format(
                    "is node {}, but that is already a child of nodes[{}]", child, parents[child]));
            }
            parents[child] = i;
            children[i].push_back(child);
        }
    }
    // With one parent each, a node that no root reaches is below itself.
    std::vector<std::size_t> reached;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (parents[i] == none) reached.push_back(i);
    }
    std::vector<bool> is_reached(nodes.size(), false);
    for (std::size_t next = 0; next < reached.size(); ++next) {
        is_reached[reached[next]] = true;
        const auto& below = children[reached[next]];
        reached.insert(reached.end(), below.begin(), below.end());
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!is_reached[i]) nodes[i].refuse("is its own ancestor or below a node that is");
    }
}

}  // namespace

void check_node_graph(const JsonPlace& root) {
    for (const auto& camera : elements_of(root, "cameras")) check_camera(camera);
    if (const auto lights = find_extension(root, "KHR_lights_punctual")) {
        static_cast<void>(lights->member("lights").array());
        for (const auto& light : elements_of(*lights, "lights")) check_light(light);
    }
    for (const auto& skin : elements_of(root, "skins")) check_skin(root, skin);
    const std::vector<JsonPlace> nodes = elements_of(root, "nodes");
    for (const auto& node : nodes) check_node(root, node);
    check_tree(root, nodes);
    for (const auto& scene : elements_of(root, "scenes")) {
        const auto list = scene.find("nodes");
        if (!list) continue;
        list->array();
        for (std::size_t i = 0; i < list->size(); ++i) check_reference(root, list->at(i), "nodes");
    }
    if (const auto scene = root.find("scene")) check_reference(root, *scene, "scenes");
}

}  // namespace gnomon::scene::internal
