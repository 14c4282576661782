// SPDX-License-Identifier: MIT
//
// Truth: traced hard shadows, to judge masks by. It is what tests and reports measure against;
// nothing at run time depends on it.
//
// A rasteriser snaps vertices to a sub-pixel grid and truth does not, so at a shadow's very edge
// the two may rightly differ. A pixel is judged only if the answer is the same everywhere within
// `band_px` of its centre; the others form the band, whose size is reported. "Everywhere" is meant:
// instead of rays, thin beams are traced, so that a needle between two rays is not missed.
//
//  1. The pixel's neighbourhood, a square of 2 * band_px, is a beam from the eye. What it meets is
//     cut to it, down to the first surface that fills it without a boundary. All of that may be
//     seen.
//  2. Each such piece sends a beam to the light. If no caster enters it, the piece is lit. If
//     triangles that join along shared edges fill it without a boundary, it is in shadow. Else its
//     answer changes somewhere inside.
//  3. If all the pieces say the same, that is the verdict; but not where an edge that a volume
//  begins
//     at enters the beam, for there a shadow's boundary passes too, whatever else lies over it.
//
// All of it in double precision. Where single precision must fail, the pixel is in the band as
// well: a caster so near the surface that no depth buffer tells on which side of it it lies, a
// surface on the near plane, light within 1e-5 rad of the surface, a T-junction's or an unwelded
// seam's crack. Faces that coincide do not shadow each other: whichever is drawn, the other one's
// cap is not in front of it. That holds for faces that are drawn; an undrawn caster's face that
// lies in a drawn surface has its own cap at that depth, and rounding decides.
//
// What it is not: it knows neither alpha tests (whole triangles cast), nor soft edges, nor the
// direction of normals (a surface is lit from the side it is seen from, or it is not judged).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::truth {

/// One posed mesh. The spans must outlive the tracer's build, not the tracer.
struct Instance {
    std::span<const glm::vec3> positions;    ///< metres, in the instance's space
    std::span<const std::uint32_t> indices;  ///< three a triangle
    glm::dmat4 world_from_local{1.0};        ///< affine
    bool casts = true;                       ///< shadow rays hit it
    bool receives = true;                    ///< primary rays hit it
};

/// What is traced.
struct Options {
    std::uint32_t width = 0;   ///< of the whole picture, in pixels
    std::uint32_t height = 0;  ///< of the whole picture, in pixels
    /// Rows that are traced, from this one on: for who wants to say how far it is, or to stop.
    std::uint32_t first_row = 0;
    std::uint32_t rows = ~0U;     ///< at most; those that there are
    double band_px = 1.0 / 16.0;  ///< at least 1/1000 is used
    /// Which places inside a pixel are judged: (0.5, 0.5) for the centre; a sample's place for
    /// MSAA.
    glm::dvec2 sample_position{0.5, 0.5};
};

/// What is true of a pixel.
enum class Verdict : std::uint8_t {
    Unjudged,  ///< nothing there, averted from the light (seen and lit from opposite sides), or out
               ///< of the light's range
    Band,      ///< within band_px of a change of the answer
    Lit,       ///< all of it that may be seen is lit
    Shadowed,  ///< all of it is in shadow
};

/// The truth for one light: a verdict a pixel, row 0 on top.
struct Picture {
    std::uint32_t width = 0;        ///< pixels
    std::uint32_t height = 0;       ///< pixels: rows that were traced
    std::vector<Verdict> verdicts;  ///< of each pixel
    /// What is true of the pixels' centres alone, within 1/1000 pixel: the verdict, but where that
    /// is Band. Band here: the answer changes at the very centre, or single precision cannot tell.
    /// Empty in a picture that was made by hand: then the band is undecided.
    std::vector<Verdict> centres = {};
};

/// A mask held against the truth. Its first half is what a mask must get right, to the last pixel.
/// Its second half takes the band in, where a rasteriser may rightly differ: by what is true of the
/// pixels' centres. That is the half that compares techniques.
struct Judgement {
    std::uint64_t pixels = 0;                 ///< all there are
    std::uint64_t lit = 0;                    ///< judged pixels that are truly lit
    std::uint64_t shadowed = 0;               ///< judged pixels that are truly in shadow
    std::uint64_t band = 0;                   ///< pixels within the band
    std::uint64_t false_shadow = 0;           ///< judged, lit in truth, not in the mask
    std::uint64_t false_light = 0;            ///< judged, in shadow in truth, not in the mask
    std::vector<std::uint32_t> wrong_pixels;  ///< indices y * width + x, at most 1000

    std::uint64_t band_lit = 0;        ///< band pixels whose centre is lit
    std::uint64_t band_shadowed = 0;   ///< band pixels whose centre is in shadow
    std::uint64_t band_undecided = 0;  ///< band pixels whose centre is on the change itself; those
                                       ///< whose centre is Unjudged are in none of the three
    std::uint64_t band_false_shadow = 0;  ///< of band_lit, not lit in the mask
    std::uint64_t band_false_light = 0;   ///< of band_shadowed, not in shadow in the mask
    /// How far, in pixels, the mask puts a shadow's edge from where it is: the largest distance
    /// from a wrong pixel, in the band or out of it, to the nearest pixel whose centre is truly
    /// what the mask says there, or undecided. That is the directed Hausdorff distance from the
    /// mask to the truth, for shadow and light, whichever is larger, over what is judged at all.
    /// One pixel wrong at an edge: 1. A streak through the light: the way to the next shadow.
    /// Infinite where the truth has no such pixel: a shadow where there is none.
    double edge_displacement_px = 0.0;

    /// Pixels whose answer is certain.
    [[nodiscard]] std::uint64_t judged() const { return lit + shadowed; }
    /// Of them, those that the mask gets wrong.
    [[nodiscard]] std::uint64_t wrong() const { return false_shadow + false_light; }
    /// Pixels that are wrong at all, against truth without a band.
    [[nodiscard]] std::uint64_t wrong_at_all() const {
        return wrong() + band_false_shadow + band_false_light;
    }
    /// Of how many pixels wrong_at_all() is.
    [[nodiscard]] std::uint64_t decided() const { return judged() + band_lit + band_shadowed; }
    /// Intersection over union of the mask's shadow and the true one, over the judged pixels: 1
    /// where they are the same, both empty included.
    [[nodiscard]] double iou() const;
    /// The same over all decided() pixels.
    [[nodiscard]] double iou_at_all() const;

    /// Adds up judgements of several lights, samples or frames: counts are summed, the displacement
    /// is the largest, wrong_pixels go after each other, at most 1000 together.
    Judgement& operator+=(const Judgement& other);
};

/// Who builds the trees that beams walk through. Verdicts are the same.
enum class TreeBuilder : std::uint8_t {
    Best,   ///< Embree; in builds by Emscripten, which have none, as Plain
    Plain,  ///< our own, on one thread
};

/// Casters and receivers, ready to be traced. Immutable: many threads may trace.
class Tracer {
public:
    /// `origin`: a point near the camera; everything is traced relative to it, so that scenes far
    /// from the world's origin lose nothing. Fails with ErrorCode::InvalidInput for a position that
    /// is not finite or beyond 1e18 m in the world, or an index out of range, with OutOfMemory or
    /// Internal when Embree does, where that builds the search trees. Cost: a few seconds per
    /// million triangles.
    [[nodiscard]] static Result<Tracer> build(std::span<const Instance> instances,
                                              const glm::dvec3& origin,
                                              TreeBuilder builder = TreeBuilder::Best);
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;
    ~Tracer();

    /// Any projection whose depth is 1 at the near plane (shadows/view.hpp). A light's range means
    /// nothing for a directional light. Cost: two or three beams a pixel, twice that in the band,
    /// on all cores; some 10 us a pixel and core among 100,000 triangles. Deterministic.
    [[nodiscard]] Picture trace(const shadows::View& view, const shadows::Light& light,
                                const Options& options) const;

private:
    struct State;
    explicit Tracer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// `mask`: one byte a pixel, 0 = lit, row 0 on top, as big as the picture. Cost: linear in the
/// pixels.
[[nodiscard]] Judgement judge(const Picture& truth, std::span<const std::uint8_t> mask);

/// The meshes of a scene, deformed where they are: casts where there is a Caster, receives where
/// there is a Receiver.
[[nodiscard]] std::vector<Instance> instances_of(const scene::Scene& scene);

}  // namespace gnomon::truth
#pragma GCC visibility pop
