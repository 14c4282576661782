// SPDX-License-Identifier: MIT
//
// gnomon-bench: two ways of measuring in one program. Without options of ours it is Google
// Benchmark, for single functions (core_bench.cpp, system_bench.cpp). With --paired or --quick it
// compares the silhouette strategies with each other, in turns on the same lights (paired.hpp),
// which Google Benchmark cannot: it runs each benchmark to its end before the next.
#include <algorithm>
#include <cstdio>
#include <span>
#include <string_view>

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>

#include "paired.hpp"

namespace {

int run_paired(int argc, char** argv) {
    gnomon::bench::PairedOptions options;
    bool paired = false;
    CLI::App app("Compares the silhouette strategies with each other, frame by frame.",
                 "gnomon-bench");
    app.add_flag("--paired", paired, "Compare strategies rather than time single functions");
    app.add_flag("--quick", options.quick, "A few seconds, to see that it works");
    app.add_option("--out", options.out, "The JSON file")->required();
    app.add_option("--models", options.models, "A folder of glTF files")
        ->default_val("../shared/models");
    app.add_option("--seconds", options.seconds, "How long to measure, about")
        ->check(CLI::Range(1.0, 1e5));
    app.add_option("--only", options.only, "Only meshes whose name contains this");
    CLI11_PARSE(app, argc, argv);
    if (options.quick) options.seconds = std::min(options.seconds, 3.0);
    const gnomon::Status status = gnomon::bench::run_paired(options);
    if (!status) std::fprintf(stderr, "gnomon-bench: %s\n", status.error().message.c_str());
    return status ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    const auto is_ours = [](std::string_view argument) {
        return argument == "--paired" || argument == "--quick";
    };
    if (std::ranges::any_of(arguments, is_ours)) return run_paired(argc, argv);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
