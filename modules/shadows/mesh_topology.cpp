// SPDX-License-Identifier: MIT
#include "internal/mesh_topology.hpp"

#include <algorithm>
#include <tuple>

#include <gnomon/shadows/topology.hpp>

#include "internal/disjoint_sets.hpp"
#include "internal/kd_order.hpp"
#include "internal/run_jobs.hpp"

namespace gnomon::shadows::internal {

namespace {

// Components of fewer faces share their groups, so that the blocks of the tables are not cut up.
constexpr std::size_t large_component = 256;
// What FaceUse::face holds; no mesh has as many faces.
constexpr std::uint32_t face_mask = 0x7FFFFFFF;

struct HalfEdge {
    std::uint32_t low, high, face;
    std::int32_t sign;  // 0: of a face with two equal corners, which uses no edge but lies at one
};

// By low vertex, then high, then those that run low -> high first, then face.
std::vector<HalfEdge> sorted_half_edges(std::span<const std::array<std::uint32_t, 3>> faces,
                                        std::size_t vertices, const Jobs& jobs) {
    std::vector<std::uint32_t> begin(vertices + 1, 0);
    const auto each = [&](const auto& visit) {
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const auto& [a, b, c] = faces[f];
            const bool collapsed = a == b || b == c || c == a;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = faces[f][i];
                const std::uint32_t to = faces[f][(i + 1) % 3];
                if (from == to) continue;
                visit(HalfEdge{std::min(from, to), std::max(from, to),
                               static_cast<std::uint32_t>(f),
                               collapsed ? 0 : (from < to ? 1 : -1)});
            }
        }
    };
    std::size_t count = 0;
    each([&](const HalfEdge& edge) {
        ++begin[edge.low + 1];
        ++count;
    });
    for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
    std::vector<HalfEdge> result(count);
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    each([&](const HalfEdge& edge) { result[next[edge.low]++] = edge; });
    run_pieces(jobs, vertices, [&](std::size_t first, std::size_t end) {
        for (std::size_t v = first; v < end; ++v) {
            std::sort(result.begin() + begin[v], result.begin() + begin[v + 1],
                      [](const HalfEdge& a, const HalfEdge& b) {
                          return std::tuple(a.high, -a.sign, a.face) <
                                 std::tuple(b.high, -b.sign, b.face);
                      });
        }
    });
    return result;
}

bool is_regular(const MeshTopology& topology, const Edge& edge) {
    return edge_kind(std::span(topology.uses).subspan(edge.first_use, edge.use_count)) ==
           EdgeKind::Regular;
}

// Planes are where they are in dual space but for the offset, which is measured in units of the
// mesh: a box is as wide as the light can tell.
KdItem dual_of(const FacePlanes& planes, std::size_t face, float scale) {
    return {{planes.normal_x[face], planes.normal_y[face], planes.normal_z[face],
             planes.offset[face] * scale},
            static_cast<std::uint32_t>(face)};
}

float offset_scale(const FacePlanes& planes) {
    // The radius is a sum over three axes.
    const float scale = 1.7F / planes.radius;
    return scale > 0.0F && scale < 1e30F ? scale : 0.0F;
}

struct FaceItems {
    std::vector<KdItem> items;             // of all faces, group by group
    std::vector<std::span<KdItem>> lists;  // the groups, each to be sorted
};

// Also makes the groups.
FaceItems face_items(MeshTopology& topology, const FacePlanes& planes,
                     std::span<const std::uint8_t> closed) {
    std::vector<std::uint32_t> sizes(topology.components, 0);
    for (const std::uint32_t c : topology.face_components) ++sizes[c];
    // Bins: the small open ones, the small closed ones, then one for each large component.
    std::vector<std::uint32_t> bin_of(topology.components);
    std::uint32_t bins = 2;
    for (std::size_t c = 0; c < sizes.size(); ++c) {
        bin_of[c] = sizes[c] >= large_component ? bins++ : closed[c];
    }
    std::vector<std::uint32_t> begin(bins + 1, 0);
    for (const std::uint32_t c : topology.face_components) ++begin[bin_of[c] + 1];
    for (std::uint32_t b = 0; b < bins; ++b) begin[b + 1] += begin[b];
    FaceItems result;
    result.items.resize(topology.faces.size());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    const float scale = offset_scale(planes);
    for (std::size_t f = 0; f < topology.faces.size(); ++f) {
        result.items[next[bin_of[topology.face_components[f]]]++] = dual_of(planes, f, scale);
    }
    for (std::uint32_t b = 0; b < bins; ++b) {
        const std::uint32_t count = begin[b + 1] - begin[b];
        if (count == 0) continue;
        result.lists.push_back(std::span(result.items).subspan(begin[b], count));
        topology.groups.push_back({begin[b], count, b >= 2});
    }
    return result;
}

struct EdgeItems {
    std::vector<KdItem> regular;  // by the middle of their segments
    std::vector<std::uint32_t> others;
};

EdgeItems edge_items(const MeshTopology& topology, const FacePlanes& planes) {
    const float scale = offset_scale(planes);
    EdgeItems result;
    result.regular.reserve(topology.edges.size());
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
        const Edge& edge = topology.edges[e];
        if (!is_regular(topology, edge)) {
            result.others.push_back(static_cast<std::uint32_t>(e));
            continue;
        }
        const KdItem a = dual_of(planes, topology.uses[edge.first_use].face, scale);
        const KdItem b = dual_of(planes, topology.uses[edge.first_use + 1].face, scale);
        KdItem& item = result.regular.emplace_back();
        for (std::size_t d = 0; d < 4; ++d) item.key[d] = (a.key[d] + b.key[d]) * 0.5F;
        item.id = static_cast<std::uint32_t>(e);
    }
    return result;
}

template <class T>
void permute(std::vector<T>& values, std::span<const std::uint32_t> order) {
    std::vector<T> result(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) result[i] = values[order[i]];
    values = std::move(result);
}

// `order`: of all faces, by their old places. Padding stays.
void order_faces(MeshTopology& topology, FacePlanes& planes, std::span<const std::uint32_t> order) {
    permute(topology.faces, order);
    permute(topology.input_faces, order);
    permute(topology.face_components, order);
    for (std::vector<float>* values :
         {&planes.normal_x, &planes.normal_y, &planes.normal_z, &planes.offset, &planes.error}) {
        permute(*values, order);
    }
}

// `place`: of each face, by its old one.
void order_edges(MeshTopology& topology, const EdgeItems& items,
                 std::span<const std::uint32_t> place) {
    topology.regular_edges = items.regular.size();
    std::vector<Edge> edges;
    std::vector<FaceUse> uses;
    edges.reserve(topology.edges.size());
    uses.reserve(topology.uses.size());
    const auto add = [&](std::uint32_t e) {
        const Edge& edge = topology.edges[e];
        edges.push_back(
            {edge.low, edge.high, static_cast<std::uint32_t>(uses.size()), edge.use_count});
        for (std::uint32_t u = 0; u < edge.use_count; ++u) {
            FaceUse& use = uses.emplace_back(topology.uses[edge.first_use + u]);
            use.face = place[use.face] & face_mask;
        }
    };
    for (const KdItem& item : items.regular) add(item.id);
    for (const std::uint32_t e : items.others) add(e);
    topology.edges = std::move(edges);
    topology.uses = std::move(uses);
}

void find_face_edges(MeshTopology& topology) {
    topology.face_edges.assign(topology.faces.size(),
                               {ShadowMesh::no_edge, ShadowMesh::no_edge, ShadowMesh::no_edge});
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
        const Edge& edge = topology.edges[e];
        for (std::uint32_t u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
            const FaceUse use = topology.uses[u];
            const std::uint32_t from = use.backward != 0 ? edge.high : edge.low;
            const auto& face = topology.faces[use.face];
            const std::size_t corner = face[0] == from ? 0 : (face[1] == from ? 1 : 2);
            topology.face_edges[use.face][corner] = static_cast<std::uint32_t>(e);
        }
    }
}

}  // namespace

MeshTopology connect(std::vector<std::array<std::uint32_t, 3>> faces, std::size_t vertices,
                     const Jobs& jobs) {
    MeshTopology topology;
    topology.faces = std::move(faces);
    const std::vector<HalfEdge> half_edges = sorted_half_edges(topology.faces, vertices, jobs);
    DisjointSets sets(topology.faces.size());
    topology.uses.reserve(half_edges.size());
    for (std::size_t begin = 0; begin < half_edges.size();) {
        const HalfEdge& edge = half_edges[begin];
        const auto first_use = static_cast<std::uint32_t>(topology.uses.size());
        for (; begin < half_edges.size() && half_edges[begin].low == edge.low &&
               half_edges[begin].high == edge.high;
             ++begin) {
            const HalfEdge& use = half_edges[begin];
            sets.join(edge.face, use.face);
            if (use.sign == 0) continue;
            FaceUse& added = topology.uses.emplace_back();
            added.face = use.face & face_mask;
            added.backward = use.sign < 0;
        }
        const auto count = static_cast<std::uint32_t>(topology.uses.size()) - first_use;
        if (count > 0) topology.edges.push_back({edge.low, edge.high, first_use, count});
    }
    topology.input_faces.resize(topology.faces.size());
    topology.face_components.resize(topology.faces.size());
    std::vector<std::uint32_t> component_of_root(topology.faces.size());
    for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
        topology.input_faces[f] = f;
        const std::uint32_t root = sets.find(f);
        if (root == f) {
            component_of_root[f] = static_cast<std::uint32_t>(topology.components++);
        }
        topology.face_components[f] = component_of_root[root];
    }
    return topology;
}

void order_by_planes(MeshTopology& topology, FacePlanes& planes,
                     std::span<const std::uint8_t> closed, const Jobs& jobs) {
    FaceItems faces;
    EdgeItems edges;
    run_jobs(jobs, 2, [&](std::size_t task) {
        if (task == 0) edges = edge_items(topology, planes);
        if (task == 1) faces = face_items(topology, planes, closed);
    });
    std::vector<std::span<KdItem>> lists = std::move(faces.lists);
    lists.emplace_back(edges.regular);
    kd_order(std::move(lists), jobs);

    std::vector<std::uint32_t> order(faces.items.size());
    std::vector<std::uint32_t> place(faces.items.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = faces.items[i].id;
        place[order[i]] = static_cast<std::uint32_t>(i);
    }
    run_jobs(jobs, 2, [&](std::size_t task) {
        if (task == 0) order_edges(topology, edges, place);
        if (task == 1) order_faces(topology, planes, order);
    });
    find_face_edges(topology);
}

std::size_t MeshTopology::memory_bytes() const {
    return sources.capacity() * sizeof(std::uint32_t) +
           (faces.capacity() + face_edges.capacity()) * sizeof(std::array<std::uint32_t, 3>) +
           (input_faces.capacity() + face_components.capacity()) * sizeof(std::uint32_t) +
           edges.capacity() * sizeof(Edge) + uses.capacity() * sizeof(FaceUse) +
           groups.capacity() * sizeof(FaceGroup);
}

}  // namespace gnomon::shadows::internal
