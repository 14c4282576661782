// SPDX-License-Identifier: MIT
//
// A report as CSV and as JSON, and what follows from its figures.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gnomon/report/writers.hpp>

#include "internal/json_forms.hpp"
#include "internal/page_parts.hpp"
#include "internal/plot.hpp"

namespace gnomon::report {

namespace {

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

// What plots need: so that it is decided in one place.
void add_what_follows(nlohmann::ordered_json& json, const Cell& cell) {
    const auto names = [&](const std::vector<std::size_t>& rows) {
        std::vector<std::string> list;
        for (const std::size_t row : rows) list.push_back(cell.rows[row].technique);
        return list;
    };
    json["front"] = names(pareto_front(cell));
    json["worth_a_name"] = names(internal::worth_a_name(cell));
    for (std::size_t i = 0; i < cell.rows.size(); ++i) {
        if (cell.rows[i].skipped.empty()) {
            json["rows"][i]["comparable_ms"] = comparable_ms(cell, cell.rows[i]);
        }
    }
}

}  // namespace

std::string to_csv(const Report& report) {
    std::string csv =
        "scene,kind,backend,adapter,technique,family,skipped,frame_ms_median,frame_ms_p95,"
        "detect_ms,build_ms,record_ms,upload_bytes,layers,wrong_median,wrong_worst,"
        "false_shadow_worst,false_light_worst,wrong_share_worst,wrong_at_all_median,"
        "wrong_at_all_worst,band_share,edge_displacement_px,iou_median,iou_worst,against_auto,"
        "against_auto_low,against_auto_high\r\n";
    for (const Cell& cell : report.cells) {
        for (const Row& row : cell.rows) {
            csv += fmt::format("{},{},{},{},{},{},{}", quoted(cell.scene), to_string(cell.kind),
                               quoted(cell.backend), quoted(cell.adapter), quoted(row.technique),
                               quoted(row.family), quoted(row.skipped));
            if (!row.skipped.empty()) {
                csv += std::string(21, ',') + "\r\n";
                continue;
            }
            const Errors& e = row.errors;
            csv += fmt::format(
                ",{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{},{},{},{},{:.8f},{},{},{:.8f},{:.4f},"
                "{:.8f},{:.8f},{:.4f},{:.4f},{:.4f}\r\n",
                row.frame_ms.median, row.frame_ms.p95, row.detect_ms.median, row.build_ms.median,
                row.record_ms.median, row.upload_bytes, row.layers, e.wrong_median, e.wrong_worst,
                e.false_shadow_worst, e.false_light_worst, e.wrong_share_worst,
                e.wrong_at_all_median, e.wrong_at_all_worst, e.band_share, e.edge_displacement_px,
                e.iou_median, e.iou_worst, row.against_auto.mean, row.against_auto.low,
                row.against_auto.high);
        }
    }
    return csv;
}

std::string to_json(const Report& report) {
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (const Cell& cell : report.cells) {
        auto json = internal::json_of(cell, false);
        add_what_follows(json, cell);
        cells.push_back(std::move(json));
    }
    nlohmann::ordered_json left_out = nlohmann::ordered_json::array();
    for (const LeftOut& scene : report.left_out) {
        left_out.push_back(
            {{"scene", scene.scene}, {"source", scene.source}, {"reason", scene.reason}});
    }
    const nlohmann::ordered_json json{{"version", report.options.version},
                                      {"command", report.command},
                                      {"machine",
                                       {{"processor", report.machine.processor},
                                        {"cores", report.machine.cores},
                                        {"system", report.machine.system}}},
                                      {"width", report.options.width},
                                      {"height", report.options.height},
                                      {"frames", report.options.frames},
                                      {"rounds", report.options.rounds},
                                      {"degrees_per_frame", report.options.degrees_per_frame},
                                      {"left_out", left_out},
                                      {"cells", cells}};
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

double comparable_ms(const Cell& cell, const Row& row) {
    const Row* automatic = cell.rows.empty() ? nullptr : &cell.rows[0];
    if (automatic == nullptr || !automatic->skipped.empty()) return row.frame_ms.median;
    return automatic->frame_ms.median * row.against_auto.mean;
}

std::vector<std::size_t> pareto_front(const Cell& cell) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < cell.rows.size(); ++i) {
        if (cell.rows[i].skipped.empty()) order.push_back(i);
    }
    const auto cost = [&](std::size_t i) {
        return std::pair(comparable_ms(cell, cell.rows[i]), cell.rows[i].errors.wrong_worst);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cost(a) < cost(b); });
    // By luck alone one of many that are as good as "auto" always looks a little faster.
    const Row* automatic = internal::find_row(cell, "auto");
    const auto is_like_auto = [&](const Row& row) {
        return automatic != nullptr && &row != automatic &&
               row.errors.wrong_worst == automatic->errors.wrong_worst &&
               row.against_auto.high >= 1.0;
    };
    std::vector<std::size_t> front;
    for (const std::size_t i : order) {
        if (is_like_auto(cell.rows[i])) continue;
        if (front.empty() ||
            cell.rows[i].errors.wrong_worst < cell.rows[front.back()].errors.wrong_worst) {
            front.push_back(i);
        }
    }
    return front;
}

std::vector<std::size_t> better_than_auto(const Cell& cell) {
    std::vector<std::size_t> better;
    if (cell.rows.empty() || !cell.rows[0].skipped.empty()) return better;
    const std::uint64_t wrong = cell.rows[0].errors.wrong_worst;
    for (std::size_t i = 1; i < cell.rows.size(); ++i) {
        const Row& row = cell.rows[i];
        if (row.skipped.empty() && row.errors.wrong_worst <= wrong &&
            row.against_auto.high < 0.95) {
            better.push_back(i);
        }
    }
    return better;
}

}  // namespace gnomon::report
