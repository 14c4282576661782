// SPDX-License-Identifier: MIT
//
// Each rule on small made-up trees: what it lets pass and what it catches.
#include "tests/layers/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::layers {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view licence = "// SPDX-License-Identifier: MIT\n";

std::vector<Violation> includes_in(std::string path, const std::string& include) {
    const std::vector<SourceFile> tree{{std::move(path), "#include " + include + "\n"}};
    return check_includes(tree);
}

TEST(IncludesOf, FindsBothKindsWithTheirLines) {
    const std::vector<Include> found =
        includes_of("// text\n#include <vector>\n\n  # include \"internal/a.hpp\"  // why\nint x;");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].name, "vector");
    EXPECT_FALSE(found[0].quoted);
    EXPECT_EQ(found[0].line, 2U);
    EXPECT_EQ(found[1].name, "internal/a.hpp");
    EXPECT_TRUE(found[1].quoted);
    EXPECT_EQ(found[1].line, 4U);
}

TEST(IncludesOf, LeavesOtherDirectivesAlone) {
    EXPECT_THAT(includes_of("#pragma once\n#define include <a>\n// #include\n#include MACRO\n#"),
                IsEmpty());
}

struct IncludeRow {
    const char* name;
    const char* path;
    const char* include;
    const char* complaint;  ///< part of it; null where the include is allowed
};

void PrintTo(const IncludeRow& row, std::ostream* out) { *out << row.name; }

class IncludeRule : public testing::TestWithParam<IncludeRow> {};

TEST_P(IncludeRule, Holds) {
    const IncludeRow& row = GetParam();
    const std::vector<Violation> found = includes_in(row.path, row.include);
    if (row.complaint == nullptr) {
        EXPECT_THAT(found, IsEmpty());
    } else {
        EXPECT_THAT(found, ElementsAre(AllOf(HasSubstr(row.path), HasSubstr(row.complaint))));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Allowed, IncludeRule,
    testing::Values(
        IncludeRow{"std", "modules/core/a.hpp", "<vector>", nullptr},
        IncludeRow{"tl", "modules/core/a.hpp", "<tl/expected.hpp>", nullptr},
        IncludeRow{"core", "modules/shadows/a.hpp", "<gnomon/core/result.hpp>", nullptr},
        IncludeRow{"itself", "modules/shadows/a.cpp", "<gnomon/shadows/light.hpp>", nullptr},
        IncludeRow{"glm", "modules/shadows/a.cpp", "<glm/glm.hpp>", nullptr},
        IncludeRow{"own_private", "modules/shadows/a.cpp", "\"internal/pair.hpp\"", nullptr},
        IncludeRow{"below_below", "modules/render/a.cpp", "<gnomon/shadows/view.hpp>", nullptr},
        IncludeRow{"adapter", "modules/scene/shadow_adapter.cpp", "<gnomon/shadows/light.hpp>",
                   nullptr},
        IncludeRow{"glfw", "backends/gl/glfw_context.cpp", "<GLFW/glfw3.h>", nullptr},
        IncludeRow{"volk", "backends/vk/device.cpp", "<volk.h>", nullptr},
        IncludeRow{"webgpu_json", "backends/webgpu/objects.cpp", "<nlohmann/json.hpp>", nullptr},
        IncludeRow{"embree", "modules/truth/truth.cpp", "<embree3/rtcore.h>", nullptr},
        IncludeRow{"report", "modules/report/page.cpp", "<gnomon/truth/truth.hpp>", nullptr},
        IncludeRow{"app", "apps/gnomon/main.cpp", "<gnomon/render/renderer.hpp>", nullptr},
        IncludeRow{"app_private", "apps/gnomon/main.cpp", "\"internal/options.hpp\"", nullptr},
        IncludeRow{"test", "tests/gpu/a.cpp", "\"modules/gpu/internal/wording.hpp\"", nullptr},
        IncludeRow{"not_code", "docs/a.md", "<gnomon/gl/backend.hpp>", nullptr}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Forbidden, IncludeRule,
    testing::Values(
        IncludeRow{"core_up", "modules/core/a.hpp", "<gnomon/gpu/types.hpp>",
                   "core must not use gpu"},
        IncludeRow{"shadows_gpu", "modules/shadows/a.cpp", "<gnomon/gpu/types.hpp>",
                   "shadows must not use gpu"},
        IncludeRow{"shadows_scene", "modules/shadows/a.cpp", "<gnomon/scene/scene.hpp>",
                   "shadows must not use scene"},
        IncludeRow{"shadows_fmt", "modules/shadows/a.cpp", "<fmt/format.h>",
                   "shadows must not use that library"},
        IncludeRow{"shadows_gl", "modules/shadows/a.cpp", "<GL/glcorearb.h>",
                   "shadows must not use that library"},
        IncludeRow{"gpu_shadows", "modules/gpu/a.cpp", "<gnomon/shadows/light.hpp>",
                   "gpu must not use shadows"},
        IncludeRow{"gpu_backend", "modules/gpu/a.cpp", "<gnomon/vk/backend.hpp>",
                   "gpu must not use vk"},
        IncludeRow{"gpu_vulkan", "modules/gpu/a.cpp", "<vulkan/vulkan.h>",
                   "gpu must not use that library"},
        IncludeRow{"pass_scene", "modules/shadow_pass/a.cpp", "<gnomon/scene/scene.hpp>",
                   "shadow_pass must not use scene"},
        IncludeRow{"pass_backend", "modules/shadow_pass/a.cpp", "<gnomon/gl/backend.hpp>",
                   "shadow_pass must not use gl"},
        IncludeRow{"scene_shadows", "modules/scene/scene.cpp", "<gnomon/shadows/light.hpp>",
                   "scene must not use shadows"},
        IncludeRow{"scene_adapter", "modules/scene/scene.cpp", "<gnomon/scene/shadow_adapter.hpp>",
                   "scene must not use scene_shadows"},
        IncludeRow{"adapter_gpu", "modules/scene/shadow_adapter.cpp", "<gnomon/gpu/device.hpp>",
                   "scene_shadows must not use gpu"},
        IncludeRow{"render_backend", "modules/render/a.cpp", "<gnomon/vk/backend.hpp>",
                   "render must not use vk"},
        IncludeRow{"truth_gpu", "modules/truth/a.cpp", "<gnomon/gpu/device.hpp>",
                   "truth must not use gpu"},
        IncludeRow{"truth_report", "modules/truth/a.cpp", "<gnomon/report/report.hpp>",
                   "truth must not use report"},
        IncludeRow{"report_backend", "modules/report/a.cpp", "<gnomon/gl/backend.hpp>",
                   "report must not use gl"},
        IncludeRow{"gl_vk", "backends/gl/a.cpp", "<gnomon/vk/backend.hpp>", "gl must not use vk"},
        IncludeRow{"vk_gl", "backends/vk/a.cpp", "<gnomon/gl/backend.hpp>", "vk must not use gl"},
        IncludeRow{"gl_shadows", "backends/gl/a.cpp", "<gnomon/shadows/light.hpp>",
                   "gl must not use shadows"},
        IncludeRow{"vk_opengl", "backends/vk/a.cpp", "<GL/glcorearb.h>",
                   "vk must not use that library"},
        IncludeRow{"others_private", "modules/shadow_pass/a.cpp",
                   "<gnomon/gpu/internal/wording.hpp>", "by their own folder alone"},
        IncludeRow{"dots", "modules/shadow_pass/a.cpp", "\"../gpu/internal/wording.hpp\"",
                   "quotes are for headers of its own folder"},
        IncludeRow{"from_root", "modules/gpu/a.cpp", "\"modules/shadows/light.hpp\"",
                   "quotes are for headers of its own folder"},
        IncludeRow{"no_layer", "modules/misc/a.cpp", "<vector>", "belongs to no layer"},
        IncludeRow{"app_behind", "apps/gnomon/main.cpp", "<gnomon/gpu/internal/wording.hpp>",
                   "public headers alone"},
        IncludeRow{"example_dots", "examples/a.cpp", "\"../modules/gpu/device.hpp\"",
                   "public headers alone"},
        IncludeRow{"example_private", "examples/a.cpp", "\"internal/helper.hpp\"",
                   "nothing private"},
        IncludeRow{"game_private", "apps/game/main.cpp", "\"internal/helper.hpp\"",
                   "nothing private"}),
    [](const auto& row) { return row.param.name; });

TEST(GameIncludes, AreItsOwnAndTwoOfTheTools) {
    std::vector<SourceFile> tree{{"apps/game/world.hpp", ""},
                                 {"apps/gnomon/render_setup.hpp", ""},
                                 {"apps/game/main.cpp",
                                  "#include \"world.hpp\"\n#include \"devices.hpp\"\n"
                                  "#include \"files.hpp\"\n"}};
    EXPECT_THAT(check_includes(tree), IsEmpty());
    tree.push_back({"apps/game/other.cpp", "#include \"render_setup.hpp\"\n"});
    EXPECT_THAT(check_includes(tree),
                ElementsAre(HasSubstr("apps/game/other.cpp:1 includes render_setup.hpp in quotes; "
                                      "the game has its own headers")));
}

TEST(BackendChoice, OneFileOfTheAppsMayNameBoth) {
    const std::string both = "#include <gnomon/gl/backend.hpp>\n#include <gnomon/vk/backend.hpp>\n";
    std::vector<SourceFile> tree{{"apps/gnomon/device.cpp", both},
                                 {"apps/gnomon/window.cpp", "#include <gnomon/gl/context.hpp>\n"},
                                 {"tests/support/devices.cpp", both}};
    EXPECT_THAT(check_backend_choice(tree), IsEmpty());
    tree.push_back({"apps/game/main.cpp", both});
    EXPECT_THAT(check_backend_choice(tree), ElementsAre(AllOf(HasSubstr("apps/gnomon/device.cpp"),
                                                              HasSubstr("apps/game/main.cpp"))));
}

TEST(Lengths, LimitsAreThreeHundredAndSixHundred) {
    const auto lines = [](std::size_t n) {
        std::string text;
        for (std::size_t i = 0; i < n; ++i) text += "x\n";
        return text;
    };
    const std::vector<SourceFile> tree{
        {"a.hpp", lines(300)},          {"b.hpp", lines(301)}, {"a.cpp", lines(600)},
        {"b.cpp", lines(600) + "last"}, {"a.md", lines(900)},
    };
    EXPECT_THAT(check_lengths(tree), ElementsAre("b.hpp has 301 lines; the limit is 300.",
                                                 "b.cpp has 601 lines; the limit is 600."));
}

TEST(LicenceLines, ComeFirst) {
    const std::vector<SourceFile> tree{{"a.hpp", std::string(licence)},
                                       {"b.hpp", "#pragma once\n" + std::string(licence)},
                                       {"c.cpp", ""},
                                       {"d.md", ""}};
    EXPECT_THAT(check_licence_lines(tree),
                ElementsAre(HasSubstr("b.hpp does not"), HasSubstr("c.cpp does not")));
}

TEST(Visibility, IsSaidInPublicHeadersOfWhatIsInstalled) {
    const std::string body = "\nnamespace gnomon::gpu {\n}  // namespace gnomon::gpu\n";
    const std::vector<SourceFile> tree{
        {"modules/gpu/good.hpp", "#pragma once\n#pragma GCC visibility push(default)" + body +
                                     "#pragma GCC visibility pop\n"},
        {"modules/gpu/bare.hpp", body},
        {"backends/gl/open.hpp", "\n#pragma GCC visibility push(default)" + body},
        {"modules/core/macro.hpp", "#define X\n"},
        {"modules/gpu/internal/a.hpp", body},
        {"modules/sun/position.hpp", body}};
    EXPECT_THAT(check_visibility(tree),
                ElementsAre(HasSubstr("gpu/bare.hpp"), HasSubstr("gl/open.hpp")));
}

TEST(MachinePaths, AreFoundWhereverTheyStand) {
    const std::string slash = "/";
    const std::vector<SourceFile> tree{
        {"a.cpp", "int a;\n// see " + slash + "work/x\n"},
        {"b.md", slash + "home/me"},
        {"c.json", "\"" + slash + "root/y\""},
        {"d.md", "https://example.org/home/page, ${HOME}/code/x, the light/home balance"}};
    EXPECT_THAT(check_machine_paths(tree),
                ElementsAre(HasSubstr("a.cpp:2 names"), HasSubstr("b.md:1 names"),
                            HasSubstr("c.json:1 names")));
}

}  // namespace
}  // namespace gnomon::layers
