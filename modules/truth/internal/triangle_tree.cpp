// SPDX-License-Identifier: MIT
#include "internal/triangle_tree.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace gnomon::truth::internal {

namespace {

constexpr std::size_t max_leaf = 2;

// What Embree's builder calls back for. Memory belongs to the RTCBVH and dies with it.
struct BuiltNode {
    std::array<RTCBounds, 2> bounds{};
    std::array<BuiltNode*, 2> children{};
    std::array<std::uint32_t, max_leaf> triangles{};
    std::uint32_t count = 0;  // 0: an inner node
};

void* allocate(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), 16)) BuiltNode;
}
void* create_node(RTCThreadLocalAllocator allocator, unsigned int, void*) {
    return allocate(allocator);
}
void set_children(void* node, void** children, unsigned int count, void*) {
    for (unsigned int i = 0; i < count; ++i) {
        static_cast<BuiltNode*>(node)->children[i] = static_cast<BuiltNode*>(children[i]);
    }
}
void set_bounds(void* node, const RTCBounds** bounds, unsigned int count, void*) {
    for (unsigned int i = 0; i < count; ++i) static_cast<BuiltNode*>(node)->bounds[i] = *bounds[i];
}
void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void*) {
    auto* leaf = static_cast<BuiltNode*>(allocate(allocator));
    for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
    leaf->count = static_cast<std::uint32_t>(count);
    return leaf;
}

float below(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) <= value
               ? rounded
               : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}
float above(double value) { return -below(-value); }

RTCBuildPrimitive bounds_of(const Triangle& triangle, std::uint32_t number) {
    const auto& c = triangle.corners;
    const glm::dvec3 min = glm::min(glm::min(c[0], c[1]), c[2]);
    const glm::dvec3 max = glm::max(glm::max(c[0], c[1]), c[2]);
    RTCBuildPrimitive bounds{};
    bounds.lower_x = below(min.x);
    bounds.lower_y = below(min.y);
    bounds.lower_z = below(min.z);
    bounds.upper_x = above(max.x);
    bounds.upper_y = above(max.y);
    bounds.upper_z = above(max.z);
    bounds.primID = number;
    return bounds;
}

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseBvh {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Bvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh>;

tl::unexpected<Error> embree_failed(RTCDevice device, std::size_t triangles) {
    const RTCError code = rtcGetDeviceError(device);
    return fail(code == RTC_ERROR_OUT_OF_MEMORY ? ErrorCode::OutOfMemory : ErrorCode::Internal,
                fmt::format("Embree could not build a tree over {} triangles (its error {}).",
                            triangles, static_cast<int>(code)));
}

}  // namespace

struct TriangleTree::Flattener {
    TriangleTree& tree;

    void flatten(const BuiltNode& built, std::uint32_t place) {
        if (built.count > 0) {
            tree.nodes_[place].first = static_cast<std::uint32_t>(tree.order_.size());
            tree.nodes_[place].count = built.count;
            for (std::uint32_t i = 0; i < built.count; ++i) {
                tree.order_.push_back(built.triangles[i]);
            }
            return;
        }
        const auto children = static_cast<std::uint32_t>(tree.nodes_.size());
        tree.nodes_[place].first = children;
        tree.nodes_.resize(tree.nodes_.size() + 2);
        for (std::uint32_t i = 0; i < 2; ++i) {
            const RTCBounds& b = built.bounds[i];
            tree.nodes_[children + i].min = {b.lower_x, b.lower_y, b.lower_z};
            tree.nodes_[children + i].max = {b.upper_x, b.upper_y, b.upper_z};
        }
        for (std::uint32_t i = 0; i < 2; ++i) flatten(*built.children[i], children + i);
    }
};

Result<TriangleTree> TriangleTree::build(std::span<const Triangle> triangles,
                                         std::vector<std::uint32_t> chosen) {
    TriangleTree tree;
    if (chosen.empty()) return tree;
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(chosen.size());
    Node root;
    root.min = glm::vec3(std::numeric_limits<float>::infinity());
    root.max = -root.min;
    for (const std::uint32_t i : chosen) {
        const RTCBuildPrimitive& p = primitives.emplace_back(bounds_of(triangles[i], i));
        root.min = glm::min(root.min, glm::vec3(p.lower_x, p.lower_y, p.lower_z));
        root.max = glm::max(root.max, glm::vec3(p.upper_x, p.upper_y, p.upper_z));
    }

    const Device device(rtcNewDevice(nullptr));
    if (!device) return embree_failed(nullptr, chosen.size());
    const Bvh bvh(rtcNewBVH(device.get()));
    if (!bvh) return embree_failed(device.get(), chosen.size());
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxDepth = max_depth;
    arguments.maxLeafSize = max_leaf;
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    const auto* built = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
    if (built == nullptr) return embree_failed(device.get(), chosen.size());

    tree.nodes_.push_back(root);
    tree.order_.reserve(chosen.size());
    Flattener{tree}.flatten(*built, 0);
    return tree;
}

}  // namespace gnomon::truth::internal
