// SPDX-License-Identifier: MIT
//
// Sources: F. C. Crow, "Shadow Algorithms for Computer Graphics" (1977), for the volume; P.
// Bergeron, "A General Version of Crow's Shadow Volumes" (1986), for edge multiplicities on open
// meshes; B. Kim, K. Kim and G. Turk, "A Shadow-Volume Algorithm for Opaque and Transparent
// Nonmanifold Casters" (2008), for any mesh.
#include <gnomon/shadows/volume.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include <gnomon/shadows/layer_bound.hpp>

#include "internal/layers.hpp"

namespace gnomon::shadows {

namespace {

std::uint32_t near_vertex(std::uint32_t v) { return 2 * v; }
std::uint32_t far_vertex(std::uint32_t v) { return 2 * v + 1; }

bool lexicographically_less(const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// Writes triangles one after the other; the room has been made.
class Pen {
public:
    Pen(std::vector<std::uint32_t>& indices, std::uint64_t first) : at_(indices.data() + first) {}

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        at_[0] = a;
        at_[1] = b;
        at_[2] = c;
        at_ += 3;
    }

private:
    std::uint32_t* at_;
};

// ---------------------------------------------------------------------------------------------
// Which faces are which kind of cap, and which of them are ranges

enum Kind : std::uint8_t { Near, Flipped, Averted, None };
using Kinds = std::array<std::uint64_t, 3>;

// A run, or the part of one whose faces are of one kind, or faces between runs, that do not cast.
struct Segment {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t weight = 0;  // without its sign
    Kind kind = None;
};

// All of the mesh, segment by segment. Calls visit(const Segment&).
template <class Visit>
void for_each_segment(const ShadowMesh& mesh, std::span<const FaceRun> casting,
                      std::span<const std::uint8_t> solid_averted, Visit&& visit) {
    const auto is_set = [](std::uint8_t averted) { return averted != 0; };
    const bool any = std::any_of(solid_averted.begin(), solid_averted.end(), is_set);
    const bool all = any && std::all_of(solid_averted.begin(), solid_averted.end(), is_set);
    const auto components = mesh.face_components();
    std::uint32_t at = 0;
    for (const FaceRun& run : casting) {
        if (run.first > at) visit(Segment{at, run.first - at, 0, None});
        at = run.first + run.count;
        const auto weight = static_cast<std::uint32_t>(std::abs(run.weight));
        if (run.weight > 0 || !any || all) {
            visit(Segment{run.first, run.count, weight,
                          run.weight > 0 ? Near
                          : all          ? Averted
                                         : Flipped});
            continue;
        }
        for (std::uint32_t first = run.first; first < at;) {
            const bool averted = is_set(solid_averted[components[first]]);
            std::uint32_t last = first + 1;
            while (last < at && is_set(solid_averted[components[last]]) == averted) ++last;
            visit(Segment{first, last - first, weight, averted ? Averted : Flipped});
            first = last;
        }
    }
}

// What a segment costs, in faces that are written out, within a range of some kind.
std::uint64_t written_within(const Segment& s, Kind range) {
    if (range == None || range != s.kind) {
        const std::uint64_t own = std::uint64_t{s.count} * s.weight;
        return range == None ? own : own + s.count;  // undone
    }
    return std::uint64_t{s.count} * (s.weight - 1);
}

// Ranges so that faces written out and `worth` for each range are as little as they can be: the
// shortest way through the mesh's order, segment by segment, where each is within a range of a kind
// or in none. After A. J. Viterbi (1967).
class Ranges {
public:
    Ranges(std::span<const Segment> segments, std::uint64_t worth) {
        constexpr std::size_t states = 4;
        std::array<std::uint64_t, states> cost{worth, worth, worth, 0};
        std::vector<std::uint8_t> came(segments.size());  // two bits a state
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const auto cheapest =
                static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
            std::array<std::uint64_t, states> next{};
            for (std::size_t state = 0; state < states; ++state) {
                // The last of equals, so that a range is not begun for nothing.
                const std::uint64_t begun = cost[cheapest] + (state == None ? 0 : worth);
                const bool stays = i == 0 || cost[state] <= begun;
                next[state] = (stays ? cost[state] : begun) +
                              written_within(segments[i], static_cast<Kind>(state));
                came[i] =
                    static_cast<std::uint8_t>(came[i] | (stays ? state : cheapest) << (2 * state));
            }
            cost = next;
        }
        kinds_.resize(segments.size());
        auto state = static_cast<std::size_t>(std::min_element(cost.rbegin(), cost.rend()).base() -
                                              cost.begin() - 1);
        for (std::size_t i = segments.size(); i-- > 0;) {
            kinds_[i] = static_cast<Kind>(state);
            state = came[i] >> (2 * state) & 3U;
        }
        for (std::size_t i = 0; i < segments.size(); ++i) {
            if (kinds_[i] == None) continue;
            if (i == 0 || kinds_[i - 1] != kinds_[i]) stretches_.push_back({i, i, 0});
            Stretch& stretch = stretches_.back();
            stretch.end = i + 1;
            stretch.saved += static_cast<std::int64_t>(written_within(segments[i], None)) -
                             static_cast<std::int64_t>(written_within(segments[i], kinds_[i]));
        }
    }

    [[nodiscard]] Kind kind(std::size_t segment) const { return kinds_[segment]; }
    [[nodiscard]] std::size_t count() const { return stretches_.size(); }
    /// How many faces fewer are written out than without ranges.
    [[nodiscard]] std::int64_t saved() const {
        std::int64_t sum = 0;
        for (const Stretch& stretch : stretches_) sum += stretch.saved;
        return sum;
    }
    /// The `most` ranges that save most.
    void keep_best(std::size_t most) {
        if (count() <= most) return;
        const auto end = stretches_.begin() + static_cast<std::ptrdiff_t>(most);
        std::nth_element(stretches_.begin(), end, stretches_.end(),
                         [](const Stretch& x, const Stretch& y) {
                             return x.saved != y.saved ? x.saved > y.saved : x.begin < y.begin;
                         });
        for (auto dropped = end; dropped != stretches_.end(); ++dropped) {
            for (std::size_t i = dropped->begin; i < dropped->end; ++i) kinds_[i] = None;
        }
        stretches_.erase(end, stretches_.end());
    }

private:
    struct Stretch {
        std::size_t begin = 0;
        std::size_t end = 0;
        std::int64_t saved = 0;
    };
    std::vector<Kind> kinds_;         // of the range that a segment is within
    std::vector<Stretch> stretches_;  // the ranges, of segments
};

// The caps of a volume: ranges, and what is written out.
struct Caps {
    std::vector<Segment> written;  // each as it is written, ascending
    std::vector<Segment> undone;   // of ranges of its kind, ascending
    std::array<std::vector<FaceRange>, 3> ranges;
    Kinds written_faces{};
    Kinds undone_faces{};
    Kinds faces{};
};

// To those from place `first` on.
void add_range(std::vector<FaceRange>& ranges, std::size_t first, const Segment& s) {
    if (ranges.size() > first && ranges.back().first + ranges.back().count == s.first) {
        ranges.back().count += s.count;
    } else {
        ranges.push_back({s.first, s.count});
    }
}

void add_segment(Caps& caps, const Segment& s, Kind range) {
    if (s.kind != None) caps.faces[s.kind] += std::uint64_t{s.count} * s.weight;
    std::uint32_t left = s.weight;
    if (range != None) {
        add_range(caps.ranges[range], 0, s);
        if (range == s.kind) {
            --left;
        } else {
            caps.undone.push_back({s.first, s.count, 1, range});
            caps.undone_faces[range] += s.count;
        }
    }
    if (left > 0) {
        caps.written.push_back({s.first, s.count, left, s.kind});
        caps.written_faces[s.kind] += std::uint64_t{s.count} * left;
    }
}

Caps choose_caps(const ShadowMesh& mesh, std::span<const FaceRun> casting,
                 std::span<const std::uint8_t> solid_averted, const CapOptions& options) {
    Caps caps;
    std::uint64_t faces = 0;
    for (const FaceRun& run : casting) faces += run.count;
    if (options.max_ranges == 0 || faces <= options.draw_worth_faces) {
        for_each_segment(mesh, casting, solid_averted,
                         [&](const Segment& s) { add_segment(caps, s, None); });
        return caps;
    }
    std::vector<Segment> segments;
    for_each_segment(mesh, casting, solid_averted,
                     [&](const Segment& s) { segments.push_back(s); });
    std::uint64_t worth = options.draw_worth_faces;
    Ranges ranges(segments, worth);
    // Too many: either such as pay for more, which are joined, or the best of the others.
    while (ranges.count() > options.max_ranges) {
        worth += worth / 2 + 1;
        Ranges fewer(segments, worth);
        if (fewer.count() <= options.max_ranges) {
            ranges.keep_best(options.max_ranges);
            if (ranges.saved() >= fewer.saved()) break;
        }
        ranges = std::move(fewer);
    }
    for (std::size_t i = 0; i < segments.size(); ++i) {
        add_segment(caps, segments[i], ranges.kind(i));
    }
    return caps;
}

// ---------------------------------------------------------------------------------------------

// The near cap runs from -> to, so the side runs back along it: to, from, far from, far to.
void write_sides(const ShadowMesh& mesh, std::span<const SilhouetteEdge> silhouette,
                 bool one_far_point, Pen pen) {
    const auto positions = mesh.positions();
    for (const SilhouetteEdge& edge : silhouette) {
        const std::uint32_t a = edge.from;
        const std::uint32_t b = edge.to;
        for (std::int32_t i = 0; i < edge.count; ++i) {
            if (one_far_point) {
                pen.triangle(near_vertex(b), near_vertex(a), far_vertex(a));
            } else if (lexicographically_less(positions[a], positions[b])) {
                pen.triangle(near_vertex(b), near_vertex(a), far_vertex(b));
                pen.triangle(near_vertex(a), far_vertex(a), far_vertex(b));
            } else {
                pen.triangle(near_vertex(b), near_vertex(a), far_vertex(a));
                pen.triangle(near_vertex(b), far_vertex(a), far_vertex(b));
            }
        }
    }
}

// Each side's far edge, joined to one corner: a cone over a closed curve, so it is closed.
void write_fan(std::span<const SilhouetteEdge> silhouette, Pen pen) {
    for (const SilhouetteEdge& edge : silhouette) {
        for (std::int32_t i = 0; i < edge.count; ++i) {
            pen.triangle(far_vertex(silhouette[0].from), far_vertex(edge.to),
                         far_vertex(edge.from));
        }
    }
}

// Counter-clockwise from outside: the way round of the faces' own kind, or against it.
void write_far_faces(const ShadowMesh& mesh, const Caps& caps, Pen pen) {
    const auto write = [&](const Segment& s, bool reversed) {
        for (const auto& [a, b, c] : mesh.faces().subspan(s.first, s.count)) {
            for (std::uint32_t i = 0; i < s.weight; ++i) {
                if (reversed) {
                    pen.triangle(far_vertex(c), far_vertex(b), far_vertex(a));
                } else {
                    pen.triangle(far_vertex(a), far_vertex(b), far_vertex(c));
                }
            }
        }
    };
    for (const Segment& s : caps.written) write(s, s.kind == Near);
    for (const Segment& s : caps.undone) write(s, s.kind != Near);
}

void write_near_faces(const ShadowMesh& mesh, std::span<const Segment> segments,
                      std::array<Pen, 3> pens) {
    for (const Segment& s : segments) {
        for (const auto& [a, b, c] : mesh.faces().subspan(s.first, s.count)) {
            for (std::uint32_t i = 0; i < s.weight; ++i) {
                pens[s.kind].triangle(near_vertex(a), near_vertex(b), near_vertex(c));
            }
        }
    }
}

// CapOptions::ranges_alone(), of faces that cast once each.
void build_of_ranges(const ShadowMesh& mesh, std::span<const FaceRun> casting,
                     std::span<const SilhouetteEdge> silhouette, const VolumeOptions& options,
                     Volume& out, std::span<const std::uint8_t> solid_averted) {
    std::uint32_t sides = 0;
    for (const SilhouetteEdge& edge : silhouette) sides += static_cast<unsigned>(edge.count);
    const bool one_far_point = options.one_far_point();
    const std::uint32_t size = 3 * (one_far_point ? sides : 2 * sides);
    out.far_cap = {0, 0};
    out.sides = {0, size};
    out.ranges.clear();
    const auto add_kind = [&](CapList& list, Kind kind) {
        list = {.triples = {size, 0},
                .ranges = {static_cast<std::uint32_t>(out.ranges.size()), 0},
                .undone = {size, 0}};
        for_each_segment(mesh, casting, solid_averted, [&](const Segment& s) {
            if (s.kind != kind) return;
            list.faces += s.count;
            add_range(out.ranges, list.ranges.first, s);
        });
        list.ranges.count = static_cast<std::uint32_t>(out.ranges.size()) - list.ranges.first;
    };
    add_kind(out.near_cap, Near);
    add_kind(out.near_cap_flipped, Flipped);
    add_kind(out.near_cap_averted, Averted);
    out.far_copies = one_far_point ? FarCopies::None : FarCopies::OfAll;
    out.silhouette_edges = static_cast<std::uint32_t>(silhouette.size());
    out.made_with = options;
    out.indices.resize(size);
    write_sides(mesh, silhouette, one_far_point, Pen(out.indices, 0));
}

}  // namespace

void build_volume(const ShadowMesh& mesh, std::span<const FaceRun> casting,
                  std::span<const SilhouetteEdge> silhouette, const VolumeOptions& options,
                  Volume& out, std::span<const std::uint8_t> solid_averted) {
    const auto casts_once = [](const FaceRun& run) { return std::abs(run.weight) == 1; };
    if (options.caps.are_ranges_alone() && std::ranges::all_of(casting, casts_once)) {
        build_of_ranges(mesh, casting, silhouette, options, out, solid_averted);
        return;
    }
    const Caps caps = choose_caps(mesh, casting, solid_averted, options.caps);
    const bool one_far_point = options.one_far_point();
    std::uint64_t sides = 0;
    for (const SilhouetteEdge& edge : silhouette) sides += static_cast<unsigned>(edge.count);
    std::uint64_t written = 0;
    for (const std::uint64_t faces : caps.written_faces) written += faces;
    for (const std::uint64_t faces : caps.undone_faces) written += faces;
    const bool fan =
        options.caps.far_cap == FarCap::Fan && !one_far_point && !options.caps.are_ranges_alone();
    // Few enough that a draw for them alone would cost more.
    const bool few = written < options.caps.draw_worth_faces;

    std::uint64_t size = 0;
    const auto make_room = [&](std::uint64_t triangles) {
        const IndexRange range{static_cast<std::uint32_t>(size),
                               static_cast<std::uint32_t>(3 * triangles)};
        size += 3 * triangles;
        return range;
    };
    out.far_cap = make_room(one_far_point ? 0 : fan ? sides : few ? written : 0);
    out.sides = make_room(one_far_point ? sides : 2 * sides);
    out.ranges.clear();
    const std::array lists{&out.near_cap, &out.near_cap_flipped, &out.near_cap_averted};
    for (std::size_t kind = 0; kind < lists.size(); ++kind) {
        const auto& ranges = caps.ranges[kind];
        CapList& list = *lists[kind];
        list.triples = make_room(caps.written_faces[kind]);
        list.ranges = {static_cast<std::uint32_t>(out.ranges.size()),
                       static_cast<std::uint32_t>(ranges.size())};
        list.faces = static_cast<std::uint32_t>(caps.faces[kind]);
        out.ranges.insert(out.ranges.end(), ranges.begin(), ranges.end());
    }
    for (std::size_t kind = 0; kind < lists.size(); ++kind) {
        lists[kind]->undone = make_room(caps.undone_faces[kind]);
    }
    if (one_far_point || fan || (few && out.ranges.empty())) {
        out.far_copies = FarCopies::None;
    } else {
        out.far_copies = few ? FarCopies::OfRanges : FarCopies::OfAll;
    }
    out.silhouette_edges = static_cast<std::uint32_t>(silhouette.size());
    out.made_with = options;

    out.indices.resize(size);
    const auto at = [&](const IndexRange& range) { return Pen(out.indices, range.first); };
    write_sides(mesh, silhouette, one_far_point, at(out.sides));
    if (fan) {
        write_fan(silhouette, at(out.far_cap));
    } else if (out.far_cap.count > 0) {
        write_far_faces(mesh, caps, at(out.far_cap));
    }
    write_near_faces(mesh, caps.written,
                     {at(lists[0]->triples), at(lists[1]->triples), at(lists[2]->triples)});
    write_near_faces(mesh, caps.undone,
                     {at(lists[0]->undone), at(lists[1]->undone), at(lists[2]->undone)});
}

void build_volume(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
                  std::span<const SilhouetteEdge> silhouette, bool directional,
                  FarVertices far_vertices, Volume& out,
                  std::span<const std::uint8_t> solid_averted) {
    std::vector<FaceRun> casting;
    runs_of(weights, casting);
    build_volume(mesh, casting, silhouette, {directional, far_vertices, CapOptions::plain()}, out,
                 solid_averted);
}

Volume with_caps(const ShadowMesh& mesh, const Volume& volume, const CapOptions& caps) {
    std::vector<FaceRun> casting;
    std::vector<std::uint8_t> solid_averted(mesh.components().size(), 0);
    std::int32_t weight = 1;  // of the first list alone
    for (const CapList& list : volume.near_caps()) {
        for (const FaceRange& range :
             std::span(volume.ranges).subspan(list.ranges.first, list.ranges.count)) {
            casting.push_back({range.first, range.count, weight});
        }
        weight = -1;
    }
    const CapList& averted = volume.near_cap_averted;
    for (const FaceRange& range :
         std::span(volume.ranges).subspan(averted.ranges.first, averted.ranges.count)) {
        for (std::uint32_t f = range.first; f < range.first + range.count; ++f) {
            solid_averted[mesh.face_components()[f]] = 1;
        }
    }
    std::ranges::sort(casting, {}, &FaceRun::first);
    std::vector<SilhouetteEdge> silhouette;
    internal::silhouette_of(volume, silhouette);
    VolumeOptions options = volume.made_with;
    options.caps = caps;
    options.caps.far_cap = volume.made_with.caps.far_cap;
    Volume result;
    build_volume(mesh, casting, silhouette, options, result, solid_averted);
    return result;
}

bool fan_is_exact(const ShadowMesh& mesh, LightLocal light, FarVertices far_vertices) {
    // Nearer to the light than any face, a fan of finite vertices could be seen.
    if (far_vertices == FarVertices::OnPlane) return true;
    return !light.is_directional() && far_vertices == FarVertices::AtInfinity &&
           seen_from_outside(mesh, {.light = glm::dvec4(light.position)});
}

bool is_closed(const ShadowMesh& mesh, const Volume& volume) {
    struct Directed {
        std::uint32_t low, high;
        std::int32_t sign;
    };
    std::vector<Directed> edges;
    edges.reserve(volume.indices.size() + 6 * std::size_t{volume.cap_faces()});
    const auto name = [&](std::uint32_t index) {
        return volume.made_with.one_far_point() && index % 2 == 1 ? 1U : index;
    };
    for_each_triangle(
        mesh, volume, [&](const std::array<std::uint32_t, 3>& triangle, bool exchanged) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = name(triangle[i]);
                const std::uint32_t to = name(triangle[(i + 1) % 3]);
                if (from == to) continue;
                const bool forward = (from < to) != exchanged;
                edges.push_back({std::min(from, to), std::max(from, to), forward ? 1 : -1});
            }
        });
    std::sort(edges.begin(), edges.end(), [](const Directed& a, const Directed& b) {
        return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    });
    for (std::size_t begin = 0; begin < edges.size();) {
        std::int64_t sum = 0;
        std::size_t end = begin;
        for (; end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high;
             ++end) {
            sum += edges[end].sign;
        }
        if (sum != 0) return false;
        begin = end;
    }
    return true;
}

Extrusion infinite_extrusion(LightLocal light) {
    return {light.position.w, glm::vec4(-glm::vec3(light.position), 0.0F)};
}

Extrusion finite_extrusion(LightLocal light, double reach) {
    const glm::dvec3 l(light.position);
    if (light.is_directional()) return {1.0F, glm::vec4(glm::vec3(-reach * l), 1.0F)};
    return {static_cast<float>(reach), glm::vec4(glm::vec3((1.0 - reach) * l), 1.0F)};
}

void extrude(std::span<const glm::vec3> positions, const Extrusion& extrusion,
             std::vector<glm::vec4>& far_vertices) {
    far_vertices.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        far_vertices[i] = glm::vec4(positions[i] * extrusion.scale + glm::vec3(extrusion.offset),
                                    extrusion.offset.w);
    }
}

}  // namespace gnomon::shadows
