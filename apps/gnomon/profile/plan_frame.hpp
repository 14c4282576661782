// SPDX-License-Identifier: MIT
//
// PlanFrame: what all plan pictures have about their cells: title, legend column, scale bar, north
// arrow, and where a place of the plan is on the picture.
#pragma once

#include <string>

#include "profile/canvas.hpp"
#include "profile/study.hpp"

namespace gnomon::cli {

class PlanFrame {
public:
    explicit PlanFrame(const sun_study::PlanGrid& grid);

    [[nodiscard]] Canvas canvas() const;
    [[nodiscard]] double scale() const { return scale_; }        ///< pixels a cell
    [[nodiscard]] glm::dvec2 corner() const { return corner_; }  ///< of the cells, upper left
    [[nodiscard]] glm::dvec2 size() const { return size_; }      ///< of the cells
    [[nodiscard]] glm::dvec2 legend() const;                     ///< where the legend begins
    /// Where a point of the grid is, in cells from the upper left corner.
    [[nodiscard]] glm::dvec2 pixel(double column, double row) const {
        return corner_ + glm::dvec2(column, row) * scale_;
    }
    void draw(Canvas& canvas, const Study& study, const std::string& title,
              const std::string& subtitle) const;
    [[nodiscard]] std::string world_file() const;

private:
    sun_study::PlanGrid grid_;
    double scale_ = 1.0;
    glm::dvec2 corner_{0.0};
    glm::dvec2 size_{0.0};
};

/// The largest of 1, 2 or 5 times a power of ten that is not above `most`.
[[nodiscard]] double round_length(double most);

}  // namespace gnomon::cli
