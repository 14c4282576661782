// SPDX-License-Identifier: MIT
//
// What the page's workers call (page/truth_worker.js): a small module of its own, loaded when a
// view is checked and not before. It has a job, and judges rows of it. A worker has one module and
// a module one job.
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <emscripten/emscripten.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "truth_job.hpp"

namespace {

std::optional<gnomon::web::TruthBench> bench;
std::string answer;

}  // namespace

extern "C" {

/// An empty string, or the sentence that says what is wrong.
EMSCRIPTEN_KEEPALIVE const char* gnomon_truth_begin(const std::uint8_t* job, std::size_t job_size) {
    bench.reset();
    answer.clear();
    try {
        auto made = gnomon::web::TruthBench::create({job, job_size});
        if (made) {
            bench.emplace(std::move(*made));
        } else {
            answer = made.error().message;
        }
    } catch (const std::bad_alloc&) {
        answer = "There is not enough memory for the truth of this view.";
    }
    return answer.c_str();
}

/// {"judged", "band", "shadowed", "wrong": one a technique, "at": pixels, one list a technique} in
/// JSON, of these rows and their masks; or {"error"}, one sentence.
EMSCRIPTEN_KEEPALIVE const char* gnomon_truth_judge(std::uint32_t first_row, std::uint32_t rows,
                                                    const std::uint8_t* masks,
                                                    std::size_t masks_size) {
    if (!bench) return R"({"error": "There is no job to trace."})";
    const auto judgements = bench->judge(first_row, rows, {masks, masks_size});
    if (!judgements) {
        answer = fmt::format(R"({{"error": "{}"}})", judgements.error().message);
        return answer.c_str();
    }
    const gnomon::truth::Judgement& first = judgements->front();
    std::string wrong;
    std::string at;
    for (const gnomon::truth::Judgement& one : *judgements) {
        const char* comma = wrong.empty() ? "" : ",";
        wrong += fmt::format("{}{}", comma, one.wrong());
        at += fmt::format("{}[{}]", comma, fmt::join(one.wrong_pixels, ","));
    }
    answer = fmt::format(R"({{"judged":{},"band":{},"shadowed":{},"wrong":[{}],"at":[{}]}})",
                         first.judged(), first.band, first.shadowed, wrong, at);
    return answer.c_str();
}

}  // extern "C"
