// SPDX-License-Identifier: MIT
//
// Perspective: a picture of coloured triangles and of a plane in plan coordinates, in which what is
// nearer hides what is farther. Colours are as they are given: a heat map stays one. Four samples a
// pixel, on the processor: the pictures of a study are made of its files, on machines that need not
// draw.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

#include "profile/canvas.hpp"
#include "profile/study.hpp"

namespace gnomon::cli {

/// Where it is looked from and at, in plan coordinates.
struct PictureCamera {
    std::optional<glm::dvec3> eye_plan;
    std::optional<glm::dvec3> target_plan;
};

using PlanCorners = std::array<glm::dvec3, 3>;

class Perspective {
public:
    static constexpr std::uint32_t width = 1280;
    static constexpr std::uint32_t height = 860;

    /// Of what lies between `min` and `max`: from the camera, or from above, from the side that the
    /// sun comes from. Fails with ErrorCode::InvalidInput where eye and target are one point.
    [[nodiscard]] static Result<Perspective> create(const Study& study, const glm::dvec3& min,
                                                    const glm::dvec3& max,
                                                    const PictureCamera& camera);

    [[nodiscard]] const glm::dvec3& eye() const { return eye_; }
    /// A horizontal plane; colours by place. What is not seen of it is not asked about.
    void plane(double height_m, const std::function<Color(const glm::dvec2&)>& color_at);
    /// Both sides are seen. `lift` moves it towards the eye, as a share of the distance: a patch
    /// over the face that it is a piece of.
    void triangle(const PlanCorners& corners, const Color& color, double lift = 0.0);
    /// width x height of them, row 0 on top.
    [[nodiscard]] std::vector<Color> pixels() const;

private:
    struct Sample {
        float nearness = 0.0F;  // 1 / distance along the line of sight; 0: nothing is there
        std::array<std::uint8_t, 3> rgb{};
    };
    static constexpr std::uint32_t samples_a_side = 2;
    static constexpr std::uint32_t columns = width * samples_a_side;
    static constexpr std::uint32_t rows = height * samples_a_side;

    Perspective() : samples_(std::size_t{columns} * rows) {}
    void fill(const std::array<glm::dvec3, 3>& corners, const Color& color, double lift);

    glm::dvec3 eye_{0.0};
    glm::dmat3 view_{1.0};  // x to the right, y up, z against the line of sight
    double nearest_m_ = 0.0;
    std::vector<Sample> samples_;
};

}  // namespace gnomon::cli
