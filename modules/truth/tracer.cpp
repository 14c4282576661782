// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <limits>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include <gnomon/truth/truth.hpp>

#include "internal/camera.hpp"
#include "internal/soup.hpp"
#include "internal/triangle_tree.hpp"
#include "internal/verdict.hpp"

namespace gnomon::truth {

struct Tracer::State {
    internal::World world;
    glm::dvec3 origin{0.0};
};

Tracer::Tracer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
Tracer::~Tracer() = default;

Result<Tracer> Tracer::build(std::span<const Instance> instances, const glm::dvec3& origin,
                             TreeBuilder builder) try {
    Result<internal::Soup> soup = internal::make_soup(instances, origin);
    if (!soup) return forward_error(soup);
    std::vector<std::uint32_t> receivers;
    std::vector<std::uint32_t> casters;
    for (std::uint32_t i = 0; i < soup->triangles.size(); ++i) {
        if (soup->triangles[i].receives) receivers.push_back(i);
        if (soup->triangles[i].casts) casters.push_back(i);
    }
    auto receiver_tree = internal::TriangleTree::build(soup->triangles, receivers, builder);
    if (!receiver_tree) return forward_error(receiver_tree);
    auto caster_tree = internal::TriangleTree::build(soup->triangles, casters, builder);
    if (!caster_tree) return forward_error(caster_tree);
    internal::CasterEdges edges(*soup);
    return Tracer(std::make_unique<State>(State{
        {std::move(*soup), std::move(*receiver_tree), std::move(*caster_tree), std::move(edges)},
        origin}));
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "There is not enough memory for the truth of this scene.");
}

Picture Tracer::trace(const shadows::View& view, const shadows::Light& light,
                      const Options& options) const {
    const std::uint32_t first_row = std::min(options.first_row, options.height);
    const std::uint32_t rows = std::min(options.rows, options.height - first_row);
    Picture picture{.width = options.width, .height = rows, .verdicts = {}};
    picture.verdicts.resize(std::size_t{options.width} * rows, Verdict::Unjudged);
    picture.centres = picture.verdicts;

    const internal::Camera camera = internal::Camera::of(view, state_->origin);
    const glm::dvec4& at = light.position_world;
    const glm::dvec4 light_relative = at.w != 0.0
                                          ? glm::dvec4(glm::dvec3(at) / at.w - state_->origin, 1.0)
                                          : glm::dvec4(glm::normalize(glm::dvec3(at)), 0.0);
    const double range_m = light.range_m.value_or(std::numeric_limits<double>::infinity());
    const glm::dvec2 ndc_per_pixel(2.0 / options.width, 2.0 / options.height);
    // A beam needs some width: a thousandth of a pixel is finer than any rasteriser's grid.
    constexpr double finest_px = 1e-3;
    const glm::dvec2 band = std::max(options.band_px, finest_px) * ndc_per_pixel;
    const glm::dvec2 finest = finest_px * ndc_per_pixel;

    std::atomic<std::uint32_t> next_row{0};
    const auto work = [&] {
        internal::PixelJudge judge(state_->world, camera, light_relative, range_m);
        for (std::uint32_t y = next_row++; y < rows; y = next_row++) {
            for (std::uint32_t x = 0; x < options.width; ++x) {
                const glm::dvec2 place =
                    (glm::dvec2(x, first_row + y) + options.sample_position) * ndc_per_pixel;
                const glm::dvec2 ndc(place.x - 1.0, 1.0 - place.y);
                const std::size_t pixel = std::size_t{y} * options.width + x;
                const Verdict verdict = judge.verdict(camera.beam(ndc - band, ndc + band));
                picture.verdicts[pixel] = verdict;
                // An answer that holds everywhere in the pixel's neighbourhood holds in its middle.
                picture.centres[pixel] =
                    verdict == Verdict::Band && options.band_px > finest_px
                        ? judge.verdict(camera.beam(ndc - finest, ndc + finest))
                        : verdict;
            }
        }
    };
#ifdef __EMSCRIPTEN__
    constexpr unsigned threads = 1;  // a page that wants more has more instances
#else
    const unsigned threads = std::thread::hardware_concurrency();
#endif
    std::vector<std::thread> helpers;
    try {
        for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work);
    } catch (const std::system_error&) {
        // No more threads to be had: those that run, and this one, do all the rows.
    }
    work();
    for (std::thread& helper : helpers) helper.join();
    return picture;
}

}  // namespace gnomon::truth
