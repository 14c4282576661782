// SPDX-License-Identifier: MIT
//
// Each shader that the libraries draw with is there in GLSL and in WGSL, and the two ask the same
// of their pipeline: textures, uniform blocks to the byte, inputs and outputs. That they compute
// the same is what masks in a browser show (tests/web).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "tests/support/paths.hpp"
#include "tests/webgpu/shader_interface.hpp"

namespace gnomon::test {
namespace {

using testing::Contains;
using testing::Not;

struct Stage {
    std::string name;  ///< of the generated files, without ".spv" and ".wgsl"
};

void PrintTo(const Stage& stage, std::ostream* out) { *out << stage.name; }

std::vector<Stage> stages() {
    const std::filesystem::path source = source_folder();
    std::vector<std::pair<std::string, std::filesystem::path>> folders{
        {"shadow_pass", source / "modules/shadow_pass/shaders"},
        {"render", source / "modules/render/shaders"}};
    if (GNOMON_HAS_CONFORMANCE) {
        folders.emplace_back("conformance", source / "tests/conformance/shaders");
    }
    std::vector<Stage> found;
    for (const auto& [set, folder] : folders) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const auto extension = entry.path().extension();
            if (extension != ".vert" && extension != ".frag") continue;
            found.push_back({set + "." + entry.path().filename().string()});
        }
    }
    std::sort(found.begin(), found.end(),
              [](const Stage& a, const Stage& b) { return a.name < b.name; });
    return found;
}

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + " cannot be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string reflection_of(const std::string& spirv) {
    const std::string command = std::string(GNOMON_SPIRV_CROSS) + " '" + spirv + "' --reflect";
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("spirv-cross cannot be run");
    std::string text;
    char piece[4096];
    while (const std::size_t length = std::fread(piece, 1, sizeof piece, pipe)) {
        text.append(piece, length);
    }
    if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
    return text;
}

class Wgsl : public testing::TestWithParam<Stage> {};

TEST_P(Wgsl, asks_of_its_pipeline_what_the_glsl_asks) {
    const std::string base = std::string(GNOMON_SHADER_ROOT) + "/" + GetParam().name;
    const std::string wgsl = base + ".wgsl";
    ASSERT_TRUE(std::filesystem::exists(wgsl)) << "there is no WGSL for " << GetParam().name;
    EXPECT_EQ(interface_of_wgsl(text_of(wgsl)),
              interface_of_reflection(reflection_of(base + ".spv")));
}

std::string test_name(const testing::TestParamInfo<Stage>& info) {
    std::string name = info.param.name;
    for (char& c : name) c = c == '.' ? '_' : c;
    return name;
}

INSTANTIATE_TEST_SUITE_P(Stages, Wgsl, testing::ValuesIn(stages()), test_name);

// The reader itself: mistakes show.
constexpr const char* small_stage = R"(
struct Inner { color: vec4f, near: f32 }  // no member of a pipeline
struct Block {
    matrix: mat4x4f,
    size: vec2f,
    more: array<Inner, 3>,
}
@group(1) @binding(4) var<uniform> block: Block;
@group(2) @binding(3) var picture: texture_2d<f32>;
@group(2) @binding(103) var picture_sampler: sampler;
@group(0) @binding(7) var counts: texture_multisampled_2d<u32>;
struct Given { @builtin(position) at: vec4f, @location(2) @interpolate(flat, first) uv: vec2f }
@fragment
fn main(given: Given, @builtin(sample_index) sample: u32, @location(0) tag: u32) -> @location(1) vec4f {
    return vec4f(0.0);
}
)";

TEST(InterfaceOfWgsl, NamesWhatAPipelineHasToGive) {
    EXPECT_EQ(
        interface_of_wgsl(small_stage),
        (Interface{"in 0 uint", "in 2 vec2", "out 1 vec4", "texture 0.7 usampler2DMS",
                   "texture 2.3 sampler2D", "uniform 1.4 matrix mat4 at 0",
                   "uniform 1.4 more struct[3] every 32 at 80", "uniform 1.4 more.color vec4 at 0",
                   "uniform 1.4 more.near float at 16", "uniform 1.4 size vec2 at 64"}));
}

TEST(InterfaceOfWgsl, TellsASamplerThatBelongsToNoTexture) {
    std::string text = small_stage;
    text.replace(text.find("103"), 3, "104");
    EXPECT_THAT(interface_of_wgsl(text), Contains("sampler 2.104 without a texture"));
    EXPECT_THAT(interface_of_wgsl(small_stage), Not(Contains("sampler 2.103 without a texture")));
}

TEST(InterfaceOfReflection, NamesTheSame) {
    const Interface lines = interface_of_reflection(R"({
        "types": {"_1": {"name": "Inner", "members": [{"name": "color", "type": "vec4", "offset": 0}]},
                  "_2": {"name": "Block", "members": [
                      {"name": "size", "type": "vec2", "offset": 0},
                      {"name": "more", "type": "_1", "array": [3], "offset": 16, "array_stride": 16}]}},
        "inputs": [{"type": "mat4", "name": "m", "location": 1}],
        "outputs": [{"type": "uint", "name": "tag", "location": 0}],
        "textures": [{"type": "usampler2DMS", "name": "counts", "set": 0, "binding": 7}],
        "ubos": [{"type": "_2", "name": "Block", "set": 1, "binding": 4}]})");
    EXPECT_EQ(lines,
              (Interface{"in 1 vec4", "in 2 vec4", "in 3 vec4", "in 4 vec4", "out 0 uint",
                         "texture 0.7 usampler2DMS", "uniform 1.4 more struct[3] every 16 at 16",
                         "uniform 1.4 more.color vec4 at 0", "uniform 1.4 size vec2 at 0"}));
}

}  // namespace
}  // namespace gnomon::test
