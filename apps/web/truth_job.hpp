// SPDX-License-Identifier: MIT
//
// What a web worker traces the truth of: a view's triangles as they are posed, its lights and its
// size, as bytes that the page passes from one module to the other. So the worker reads no scene,
// and what it traces is exactly what was drawn.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/view.hpp>
#include <gnomon/truth/truth.hpp>

namespace gnomon::web {

struct TruthJob {
    struct Mesh {
        std::vector<glm::vec3> positions;
        std::vector<std::uint32_t> indices;
        glm::dmat4 world_from_local{1.0};
        bool casts = true;
        bool receives = true;
    };
    std::uint32_t width = 0;    ///< pixels
    std::uint32_t height = 0;   ///< pixels
    std::uint32_t samples = 1;  ///< 1 or 4
    double band_px = 1.0 / 16.0;
    shadows::View view;
    std::vector<shadows::Light> lights;
    std::vector<Mesh> meshes;

    /// Good while this is, and unchanged.
    [[nodiscard]] std::vector<truth::Instance> instances() const;
};

/// Copies the instances.
[[nodiscard]] TruthJob job_of(std::span<const truth::Instance> instances);
[[nodiscard]] std::vector<std::uint8_t> write_job(const TruthJob& job);
/// Fails with InvalidInput for bytes that write_job() did not write.
[[nodiscard]] Result<TruthJob> read_job(std::span<const std::uint8_t> bytes);

/// Where a sample lies in its pixel, as WebGPU has it.
[[nodiscard]] glm::dvec2 sample_position(std::uint32_t sample, std::uint32_t samples);

/// The truth of one job, held against the masks of several techniques, some rows at a time.
class TruthBench {
public:
    /// Fails as read_job() and Tracer::build() do.
    [[nodiscard]] static Result<TruthBench> create(std::span<const std::uint8_t> job);

    /// By technique, all lights and samples together. `masks` are of these rows: a byte a pixel, by
    /// technique, then light, then sample. `wrong_pixels` are those of the whole picture (y * width
    /// + x), each as often as it is wrong. Fails with InvalidInput for rows that the picture does
    /// not have, and where the masks are not as many as those of whole techniques.
    [[nodiscard]] Result<std::vector<truth::Judgement>> judge(
        std::uint32_t first_row, std::uint32_t rows, std::span<const std::uint8_t> masks) const;
    [[nodiscard]] const TruthJob& job() const { return job_; }

private:
    TruthBench(TruthJob job, truth::Tracer tracer);
    TruthJob job_;
    truth::Tracer tracer_;
};

}  // namespace gnomon::web
