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

enum Kind : std::uint8_t { Near, Flipped, Averted };

// A run, or the part of one whose faces are of one kind.
struct Segment {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::int32_t weight = 0;
    Kind kind = Near;
};

bool is_longer(const Segment& a, const Segment& b) {
    return a.count != b.count ? a.count > b.count : a.first < b.first;
}

class Caps {
public:
    Caps(const ShadowMesh& mesh, std::span<const FaceRun> casting,
         std::span<const std::uint8_t> solid_averted, const CapOptions& options)
        : mesh_(mesh), casting_(casting), solid_averted_(solid_averted), options_(options) {
        const auto is_set = [](std::uint8_t averted) { return averted != 0; };
        any_averted_ = std::any_of(solid_averted.begin(), solid_averted.end(), is_set);
        all_averted_ =
            any_averted_ && std::all_of(solid_averted.begin(), solid_averted.end(), is_set);
        choose_ranges();
    }

    // Faces of a kind that are written out, each as often as it casts, and in all.
    [[nodiscard]] std::uint64_t written(Kind kind) const { return written_[kind]; }
    [[nodiscard]] std::uint64_t faces(Kind kind) const { return faces_[kind]; }
    [[nodiscard]] std::span<const Segment> ranges() const { return ranges_; }

    // Segments that are written out, in the mesh's order.
    template <class Visit>
    void for_each_written(Visit&& visit) const {
        for_each([&](const Segment& s) {
            if (!is_range(s)) visit(s);
        });
    }

private:
    [[nodiscard]] bool is_long(const Segment& s) const {
        return std::abs(s.weight) == 1 && s.count >= options_.draw_worth_faces;
    }
    [[nodiscard]] bool is_range(const Segment& s) const {
        return is_long(s) && !ranges_.empty() && !is_longer(shortest_, s);
    }

    template <class Visit>
    void for_each(Visit&& visit) const {
        const auto components = mesh_.face_components();
        for (const FaceRun& run : casting_) {
            if (run.weight > 0 || !any_averted_ || all_averted_) {
                const Kind kind = run.weight > 0 ? Near : all_averted_ ? Averted : Flipped;
                visit(Segment{run.first, run.count, run.weight, kind});
                continue;
            }
            const std::uint32_t end = run.first + run.count;
            for (std::uint32_t first = run.first; first < end;) {
                const bool averted = solid_averted_[components[first]] != 0;
                std::uint32_t last = first + 1;
                while (last < end && (solid_averted_[components[last]] != 0) == averted) ++last;
                visit(Segment{first, last - first, run.weight, averted ? Averted : Flipped});
                first = last;
            }
        }
    }

    void choose_ranges() {
        for_each([&](const Segment& s) {
            faces_[s.kind] += std::uint64_t{s.count} * static_cast<unsigned>(std::abs(s.weight));
            if (is_long(s)) ranges_.push_back(s);
        });
        const std::size_t most = options_.max_ranges;
        if (ranges_.size() > most) {
            const auto end = ranges_.begin() + static_cast<std::ptrdiff_t>(most);
            std::nth_element(ranges_.begin(), end, ranges_.end(), is_longer);
            ranges_.resize(most);
        }
        if (!ranges_.empty()) {
            shortest_ = *std::max_element(ranges_.begin(), ranges_.end(), is_longer);
        }
        std::sort(ranges_.begin(), ranges_.end(), [](const Segment& a, const Segment& b) {
            return std::tie(a.kind, a.first) < std::tie(b.kind, b.first);
        });
        written_ = faces_;
        for (const Segment& s : ranges_) written_[s.kind] -= s.count;
    }

    const ShadowMesh& mesh_;
    std::span<const FaceRun> casting_;
    std::span<const std::uint8_t> solid_averted_;
    const CapOptions& options_;
    bool any_averted_ = false;
    bool all_averted_ = false;
    std::vector<Segment> ranges_;  // by kind, then face
    Segment shortest_;             // of them
    std::array<std::uint64_t, 3> faces_{};
    std::array<std::uint64_t, 3> written_{};
};

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

void write_far_faces(const ShadowMesh& mesh, const Caps& caps, Pen pen) {
    caps.for_each_written([&](const Segment& s) {
        for (const auto& [a, b, c] : mesh.faces().subspan(s.first, s.count)) {
            for (int i = 0; i < s.weight; ++i) {
                pen.triangle(far_vertex(c), far_vertex(b), far_vertex(a));
            }
            for (int i = 0; i < -s.weight; ++i) {
                pen.triangle(far_vertex(a), far_vertex(b), far_vertex(c));
            }
        }
    });
}

void write_near_caps(const ShadowMesh& mesh, const Caps& caps, std::array<Pen, 3> pens) {
    caps.for_each_written([&](const Segment& s) {
        for (const auto& [a, b, c] : mesh.faces().subspan(s.first, s.count)) {
            for (int i = 0; i < std::abs(s.weight); ++i) {
                pens[s.kind].triangle(near_vertex(a), near_vertex(b), near_vertex(c));
            }
        }
    });
}

}  // namespace

void build_volume(const ShadowMesh& mesh, std::span<const FaceRun> casting,
                  std::span<const SilhouetteEdge> silhouette, const VolumeOptions& options,
                  Volume& out, std::span<const std::uint8_t> solid_averted) {
    const Caps caps(mesh, casting, solid_averted, options.caps);
    const bool one_far_point = options.one_far_point();
    std::uint64_t sides = 0;
    for (const SilhouetteEdge& edge : silhouette) sides += static_cast<unsigned>(edge.count);
    const std::uint64_t written =
        caps.written(Near) + caps.written(Flipped) + caps.written(Averted);
    const bool fan = options.caps.far_cap == FarCap::Fan && !one_far_point;
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
    for (const Segment& s : caps.ranges()) out.ranges.push_back({s.first, s.count});
    std::uint32_t first_range = 0;
    const auto make_list = [&](Kind kind) {
        const auto ranges = static_cast<std::uint32_t>(
            std::count_if(caps.ranges().begin(), caps.ranges().end(),
                          [&](const Segment& s) { return s.kind == kind; }));
        const CapList list{make_room(caps.written(kind)),
                           {first_range, ranges},
                           static_cast<std::uint32_t>(caps.faces(kind))};
        first_range += ranges;
        return list;
    };
    out.near_cap = make_list(Near);
    out.near_cap_flipped = make_list(Flipped);
    out.near_cap_averted = make_list(Averted);
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
    write_near_caps(mesh, caps,
                    {at(out.near_cap.triples), at(out.near_cap_flipped.triples),
                     at(out.near_cap_averted.triples)});
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

bool fan_is_exact(const ShadowMesh& mesh, LightLocal light, FarVertices far_vertices) {
    // Nearer to the light than any face, a fan of finite vertices could be seen.
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
