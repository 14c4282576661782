// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gnomon/report/report.hpp>

namespace gnomon::report {

namespace {

double at_rank(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

// Two-sided 95 % quantile of Student's t.
double student_95(std::size_t degrees_of_freedom) {
    constexpr std::array<double, 30> table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                           2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                           2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                           2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
    if (degrees_of_freedom == 0) return std::numeric_limits<double>::infinity();
    return degrees_of_freedom <= table.size() ? table[degrees_of_freedom - 1] : 2.0;
}

template <class T>
T median_of(std::vector<T> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return {at_rank(values, 0.5), at_rank(values, 0.95), values.front(), values.back()};
}

Ratio ratio_of(const std::vector<double>& times, const std::vector<double>& reference) {
    std::vector<double> logs;
    for (std::size_t i = 0; i < std::min(times.size(), reference.size()); ++i) {
        if (times[i] > 0.0 && reference[i] > 0.0) logs.push_back(std::log(times[i] / reference[i]));
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (logs.empty()) return {1.0, 0.0, infinity};
    std::sort(logs.begin(), logs.end());
    const std::size_t cut = logs.size() / 5;
    const std::size_t kept = logs.size() - 2 * cut;
    double sum = 0.0;
    for (std::size_t i = cut; i < cut + kept; ++i) sum += logs[i];
    const double mean = sum / static_cast<double>(kept);
    if (kept < 2) return {std::exp(mean), 0.0, infinity};
    // K. K. Yuen, "The two-sample trimmed t for unequal population variances" (1974): the variance
    // is that of the sample whose ends are drawn in to the outermost values that are kept.
    const auto winsorized = [&](std::size_t i) { return logs[std::clamp(i, cut, cut + kept - 1)]; };
    double average = 0.0;
    for (std::size_t i = 0; i < logs.size(); ++i) average += winsorized(i);
    average /= static_cast<double>(logs.size());
    double squares = 0.0;
    for (std::size_t i = 0; i < logs.size(); ++i) {
        squares += (winsorized(i) - average) * (winsorized(i) - average);
    }
    const auto h = static_cast<double>(kept);
    const double half = student_95(kept - 1) * std::sqrt(squares / (h * (h - 1.0)));
    return {std::exp(mean), std::exp(mean - half), std::exp(mean + half)};
}

Errors errors_of(const std::vector<truth::Judgement>& frames) {
    Errors errors;
    if (frames.empty()) return errors;
    std::vector<std::uint64_t> wrong;
    std::vector<std::uint64_t> wrong_at_all;
    std::vector<double> iou;
    std::uint64_t band = 0;
    std::uint64_t answered = 0;
    for (const truth::Judgement& j : frames) {
        wrong.push_back(j.wrong());
        wrong_at_all.push_back(j.wrong_at_all());
        iou.push_back(j.iou_at_all());
        errors.wrong_worst = std::max(errors.wrong_worst, j.wrong());
        errors.wrong_at_all_worst = std::max(errors.wrong_at_all_worst, j.wrong_at_all());
        errors.false_shadow_worst = std::max(errors.false_shadow_worst, j.false_shadow);
        errors.false_light_worst = std::max(errors.false_light_worst, j.false_light);
        errors.edge_displacement_px = std::max(errors.edge_displacement_px, j.edge_displacement_px);
        errors.iou_worst = std::min(errors.iou_worst, j.iou_at_all());
        if (j.judged() > 0) {
            errors.wrong_share_worst =
                std::max(errors.wrong_share_worst,
                         static_cast<double>(j.wrong()) / static_cast<double>(j.judged()));
        }
        band += j.band;
        answered += j.judged() + j.band;
    }
    errors.wrong_median = median_of(wrong);
    errors.wrong_at_all_median = median_of(wrong_at_all);
    errors.iou_median = median_of(iou);
    if (answered > 0) {
        errors.band_share = static_cast<double>(band) / static_cast<double>(answered);
    }
    return errors;
}

}  // namespace gnomon::report
