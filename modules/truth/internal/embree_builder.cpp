// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "internal/box_tree.hpp"

namespace gnomon::truth::internal {

namespace {

// What Embree's builder calls back for. Memory belongs to the RTCBVH and dies with it.
struct BuiltNode {
    std::array<RTCBounds, 2> bounds{};
    std::array<BuiltNode*, 2> children{};
    std::array<std::uint32_t, BoxTree::max_leaf> numbers{};
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
    for (std::size_t i = 0; i < count; ++i) leaf->numbers[i] = primitives[i].primID;
    leaf->count = static_cast<std::uint32_t>(count);
    return leaf;
}

RTCBuildPrimitive primitive_of(const NumberedBox& box) {
    RTCBuildPrimitive primitive{};
    primitive.lower_x = box.min.x;
    primitive.lower_y = box.min.y;
    primitive.lower_z = box.min.z;
    primitive.upper_x = box.max.x;
    primitive.upper_y = box.max.y;
    primitive.upper_z = box.max.z;
    primitive.primID = box.number;
    return primitive;
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

void flatten(const BuiltNode& built, std::size_t place, BoxTree& tree) {
    if (built.count > 0) {
        tree.nodes[place].first = static_cast<std::uint32_t>(tree.order.size());
        tree.nodes[place].count = built.count;
        for (std::uint32_t i = 0; i < built.count; ++i) tree.order.push_back(built.numbers[i]);
        return;
    }
    const std::size_t children = tree.nodes.size();
    tree.nodes[place].first = static_cast<std::uint32_t>(children);
    tree.nodes.resize(children + 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const RTCBounds& b = built.bounds[i];
        tree.nodes[children + i].min = {b.lower_x, b.lower_y, b.lower_z};
        tree.nodes[children + i].max = {b.upper_x, b.upper_y, b.upper_z};
    }
    for (std::size_t i = 0; i < 2; ++i) flatten(*built.children[i], children + i, tree);
}

}  // namespace

Result<BoxTree> build_by_embree(const std::vector<NumberedBox>& boxes) {
    BoxTree tree;
    if (boxes.empty()) return tree;
    BoxTree::Node root{.min = boxes.front().min, .max = boxes.front().max};
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(boxes.size());
    for (const NumberedBox& box : boxes) {
        primitives.push_back(primitive_of(box));
        root.min = glm::min(root.min, box.min);
        root.max = glm::max(root.max, box.max);
    }
    const Device device(rtcNewDevice(nullptr));
    if (!device) return embree_failed(nullptr, boxes.size());
    const Bvh bvh(rtcNewBVH(device.get()));
    if (!bvh) return embree_failed(device.get(), boxes.size());
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxDepth = BoxTree::max_depth;
    arguments.maxLeafSize = BoxTree::max_leaf;
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    const auto* built = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
    if (built == nullptr) return embree_failed(device.get(), boxes.size());

    tree.nodes.push_back(root);
    tree.order.reserve(boxes.size());
    flatten(*built, 0, tree);
    return tree;
}

}  // namespace gnomon::truth::internal
