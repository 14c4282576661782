// SPDX-License-Identifier: MIT
#include "tests/layers/rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>

namespace gnomon::layers {

namespace {

using Names = std::vector<std::string_view>;

struct Layer {
    std::string_view name;  ///< of the target, as in docs/architecture.md
    Names path_prefixes;    ///< its files; the first layer with a matching prefix has the file
    Names may_use;          ///< layers; what they use may be used as well
    Names libraries;        ///< beginnings of foreign headers' names; the standard library is free
};

// What a header of gnomon is reached by differs from the layer's name in two places: the shadow
// adapter's header lies among the scene's, and the GLFW context's among GL's.
const std::vector<Layer>& layers() {
    static const std::vector<Layer> table{
        {"core", {"modules/core/"}, {}, {"glm/", "tl/"}},
        // immintrin.h is the compiler's own.
        {"shadows", {"modules/shadows/"}, {"core"}, {"glm/", "tl/", "immintrin.h"}},
        {"gpu", {"modules/gpu/"}, {"core"}, {"glm/", "tl/", "fmt/"}},
        {"shadow_pass",
         {"modules/shadow_pass/"},
         {"shadows", "gpu"},
         {"glm/", "tl/", "fmt/", "gnomon_shaders/shadow_pass.hpp"}},
        {"scene_shadows",
         {"modules/scene/shadow_adapter."},
         {"scene", "shadows"},
         {"glm/", "tl/", "fmt/"}},
        {"scene",
         {"modules/scene/"},
         {"core"},
         {"glm/", "tl/", "fmt/", "nlohmann/", "tiny_gltf.h"}},
        {"render",
         {"modules/render/"},
         {"scene", "scene_shadows", "shadow_pass", "gpu"},
         {"glm/", "tl/", "fmt/", "gnomon_shaders/render.hpp"}},
        {"truth", {"modules/truth/"}, {"shadows", "scene"}, {"glm/", "tl/", "fmt/", "embree3/"}},
        {"machine", {"modules/machine/"}, {}, {"unistd.h"}},
        {"report",
         {"modules/report/"},
         {"truth", "render", "machine", "scene_shadows", "shadow_pass", "gpu"},
         {"glm/", "tl/", "fmt/", "nlohmann/", "embree3/", "meshoptimizer.h",
          "stb/stb_image_write.h", "gnomon_shaders/report.hpp"}},
        {"sun", {"modules/sun/"}, {"core"}, {"glm/", "tl/", "fmt/", "erfa.h", "erfam.h"}},
        {"sun_study",
         {"modules/sun_study/"},
         {"sun", "shadows", "shadow_pass", "gpu"},
         {"glm/", "tl/", "fmt/", "gnomon_shaders/sun_study.hpp"}},
        {"input", {"modules/input/"}, {"core"}, {"glm/", "tl/", "fmt/"}},
        {"ui",
         {"modules/ui/"},
         {"gpu", "input"},
         {"glm/", "tl/", "fmt/", "imgui.h", "gnomon_shaders/ui.hpp"}},
        {"panel", {"modules/panel/"}, {"render", "ui"}, {"glm/", "tl/", "fmt/", "imgui.h"}},
        {"window",
         {"modules/window/"},
         {"gl", "vk", "gpu", "input"},
         {"glm/", "tl/", "fmt/", "GLFW/", "vulkan/"}},
        {"gl", {"backends/gl/"}, {"gpu"}, {"tl/", "fmt/", "GL/", "GLFW/", "KHR/", "dlfcn.h"}},
        {"vk", {"backends/vk/"}, {"gpu"}, {"tl/", "fmt/", "vulkan/", "volk.h", "dlfcn.h"}},
        {"webgpu", {"backends/webgpu/"}, {"gpu"}, {"tl/", "fmt/", "nlohmann/"}},
    };
    return table;
}

// Programs stand above everything; what binds them is whether they may look behind the border.
constexpr std::array<std::string_view, 2> only_public{"examples/", "apps/game/"};
constexpr std::string_view tests_folder = "tests/";

bool begins_with_any(std::string_view text, const Names& prefixes) {
    return std::ranges::any_of(prefixes, [&](std::string_view p) { return text.starts_with(p); });
}

bool ends_with_any(std::string_view text, const Names& suffixes) {
    return std::ranges::any_of(suffixes, [&](std::string_view s) { return text.ends_with(s); });
}

bool is_header(std::string_view path) { return ends_with_any(path, {".hpp", ".h"}); }
bool is_source(std::string_view path) { return ends_with_any(path, {".cpp", ".c", ".cc"}); }
bool is_code(std::string_view path) { return is_header(path) || is_source(path); }

const Layer* layer_named(std::string_view name) {
    const auto found = std::ranges::find(layers(), name, &Layer::name);
    return found == layers().end() ? nullptr : &*found;
}

const Layer* layer_of(std::string_view path) {
    const auto found = std::ranges::find_if(
        layers(), [&](const Layer& layer) { return begins_with_any(path, layer.path_prefixes); });
    return found == layers().end() ? nullptr : &*found;
}

void add_reachable(const Layer& from, std::set<std::string_view>& reachable) {
    if (!reachable.insert(from.name).second) return;
    for (const std::string_view name : from.may_use) add_reachable(*layer_named(name), reachable);
}

/// The layer whose public header `name` is, if it is one of gnomon's.
std::optional<std::string_view> layer_of_header(std::string_view name) {
    constexpr std::string_view root = "gnomon/";
    if (!name.starts_with(root)) return std::nullopt;
    name.remove_prefix(root.size());
    if (name == "scene/shadow_adapter.hpp") return "scene_shadows";
    return name.substr(0, name.find('/'));
}

bool is_standard(std::string_view name) {
    return std::ranges::all_of(
        name, [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_'; });
}

bool looks_inside(std::string_view name) {
    return name.starts_with("internal/") || name.find("/internal/") != std::string_view::npos;
}

std::string place(const SourceFile& file, const Include& include) {
    return file.path + ":" + std::to_string(include.line) + " includes " +
           std::string(include.name);
}

void check_layer_include(const SourceFile& file, const Layer& layer, const Include& include,
                         std::vector<Violation>& found) {
    if (include.quoted) {
        if (include.name.find("..") != std::string_view::npos ||
            include.name.starts_with("modules/") || include.name.starts_with("backends/") ||
            include.name.starts_with("gnomon/")) {
            found.push_back(place(file, include) +
                            " in quotes; quotes are for headers of its own folder.");
        }
        return;
    }
    if (const auto target = layer_of_header(include.name)) {
        std::set<std::string_view> reachable;
        add_reachable(layer, reachable);
        if (!reachable.contains(*target)) {
            found.push_back(place(file, include) + "; " + std::string(layer.name) +
                            " must not use " + std::string(*target) + ".");
        } else if (looks_inside(include.name)) {
            found.push_back(place(file, include) +
                            "; private headers are included in quotes, by their own folder alone.");
        }
        return;
    }
    if (!is_standard(include.name) && !begins_with_any(include.name, layer.libraries)) {
        found.push_back(place(file, include) + "; " + std::string(layer.name) +
                        " must not use that library.");
    }
}

void check_program_include(const SourceFile& file, const Include& include,
                           std::vector<Violation>& found) {
    const bool leaves_folder = include.name.find("..") != std::string_view::npos;
    const bool behind_the_border =
        looks_inside(include.name) && (!include.quoted || !include.name.starts_with("internal/"));
    if (leaves_folder || behind_the_border || include.name.starts_with("modules/") ||
        include.name.starts_with("backends/")) {
        found.push_back(place(file, include) +
                        "; a program reaches gnomon by its public headers alone.");
    } else if (looks_inside(include.name) &&
               std::ranges::any_of(only_public,
                                   [&](std::string_view p) { return file.path.starts_with(p); })) {
        found.push_back(place(file, include) +
                        "; what users read first has nothing private in it.");
    }
}

/// The game is what an embedder would write: beside public headers it includes its own, and of the
/// command-line tool the two that say which devices there are and how files are written.
void check_game_include(const SourceFile& file, const Include& include,
                        const std::set<std::string_view>& paths, std::vector<Violation>& found) {
    constexpr std::string_view folder = "apps/game/";
    constexpr std::array<std::string_view, 2> shared{"devices.hpp", "files.hpp"};
    if (!file.path.starts_with(folder) || !include.quoted) return;
    if (looks_inside(include.name)) return;  // complained of above
    const std::string own = std::string(folder) + std::string(include.name);
    if (paths.contains(own) || std::ranges::find(shared, include.name) != shared.end()) return;
    found.push_back(place(file, include) +
                    " in quotes; the game has its own headers and gnomon's public ones.");
}

std::size_t count_lines(std::string_view text) {
    const auto breaks = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    return breaks + (text.empty() || text.back() == '\n' ? 0 : 1);
}

}  // namespace

std::vector<Include> includes_of(std::string_view text) {
    std::vector<Include> includes;
    std::size_t line_number = 0;
    while (!text.empty()) {
        ++line_number;
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);

        const auto skip_blanks = [&] {
            line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        };
        skip_blanks();
        if (!line.starts_with('#')) continue;
        line.remove_prefix(1);
        skip_blanks();
        constexpr std::string_view word = "include";
        if (!line.starts_with(word)) continue;
        line.remove_prefix(word.size());
        skip_blanks();
        if (line.empty() || (line.front() != '<' && line.front() != '"')) continue;
        const bool quoted = line.front() == '"';
        line.remove_prefix(1);
        includes.push_back({line.substr(0, line.find(quoted ? '"' : '>')), quoted, line_number});
    }
    return includes;
}

std::vector<Violation> check_includes(std::span<const SourceFile> tree) {
    std::vector<Violation> found;
    std::set<std::string_view> paths;
    for (const SourceFile& file : tree) paths.insert(file.path);
    for (const SourceFile& file : tree) {
        if (!is_code(file.path) || file.path.starts_with(tests_folder)) continue;
        const Layer* layer = layer_of(file.path);
        for (const Include& include : includes_of(file.text)) {
            if (layer != nullptr) {
                check_layer_include(file, *layer, include, found);
            } else if (file.path.starts_with("modules/") || file.path.starts_with("backends/")) {
                found.push_back(file.path + " belongs to no layer that the table of layers knows.");
                break;
            } else {
                check_program_include(file, include, found);
                check_game_include(file, include, paths, found);
            }
        }
    }
    return found;
}

std::vector<Violation> check_backend_choice(std::span<const SourceFile> tree) {
    std::vector<std::string> files;
    for (const SourceFile& file : tree) {
        if (!is_code(file.path) || !file.path.starts_with("apps/")) continue;
        const std::vector<Include> includes = includes_of(file.text);
        const auto names = [&](std::string_view backend) {
            return std::ranges::any_of(
                includes, [&](const Include& i) { return layer_of_header(i.name) == backend; });
        };
        if (names("gl") && names("vk")) files.push_back(file.path);
    }
    if (files.size() <= 1) return {};
    std::string sentence = "Both backends are named by " + files.front();
    for (std::size_t i = 1; i < files.size(); ++i) sentence += " and by " + files[i];
    return {sentence + "; one file of the apps chooses between them."};
}

std::vector<Violation> check_lengths(std::span<const SourceFile> tree) {
    constexpr std::size_t header_limit = 300;
    constexpr std::size_t source_limit = 600;
    std::vector<Violation> found;
    for (const SourceFile& file : tree) {
        if (!is_code(file.path)) continue;
        const std::size_t limit = is_header(file.path) ? header_limit : source_limit;
        const std::size_t lines = count_lines(file.text);
        if (lines > limit) {
            found.push_back(file.path + " has " + std::to_string(lines) + " lines; the limit is " +
                            std::to_string(limit) + ".");
        }
    }
    return found;
}

std::vector<Violation> check_licence_lines(std::span<const SourceFile> tree) {
    std::vector<Violation> found;
    for (const SourceFile& file : tree) {
        if (is_code(file.path) && !file.text.starts_with("// SPDX-License-Identifier: MIT\n")) {
            found.push_back(file.path + " does not begin with the licence line.");
        }
    }
    return found;
}

std::vector<Violation> check_visibility(std::span<const SourceFile> tree) {
    constexpr std::array<std::string_view, 9> installed{
        "modules/core/",        "modules/shadows/", "modules/gpu/",
        "modules/shadow_pass/", "modules/scene/",   "modules/render/",
        "backends/gl/",         "backends/vk/",     "modules/truth/"};
    std::vector<Violation> found;
    for (const SourceFile& file : tree) {
        const auto folder = std::ranges::find_if(
            installed, [&](std::string_view f) { return file.path.starts_with(f); });
        if (folder == installed.end() || !is_header(file.path)) continue;
        if (file.path.find('/', folder->size()) != std::string::npos) continue;  // not public
        const std::size_t begin = file.text.find("\nnamespace gnomon");
        if (begin == std::string::npos) continue;  // macros alone
        const std::size_t end = file.text.rfind("}  // namespace gnomon");
        const std::size_t push = file.text.find("\n#pragma GCC visibility push(default)\n");
        const std::size_t pop = file.text.find("\n#pragma GCC visibility pop\n");
        if (push > begin || pop == std::string::npos || pop < end) {
            found.push_back(file.path +
                            " does not have its namespace between #pragma GCC visibility "
                            "push(default) and pop, so a shared library would hide it.");
        }
    }
    return found;
}

std::vector<Violation> check_machine_paths(std::span<const SourceFile> tree) {
    // Put together here so that this file does not hold what it looks for.
    std::vector<std::string> folders;
    for (const std::string_view name : {"work", "home", "root", "Users", "mnt"}) {
        folders.push_back("/" + std::string(name) + "/");
    }
    const auto continues_a_path = [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '}' || c == ')' ||
               c == '/' || c == '*' || c == '<' || c == '>';
    };
    std::vector<Violation> found;
    for (const SourceFile& file : tree) {
        for (const std::string& folder : folders) {
            for (std::size_t at = file.text.find(folder); at != std::string::npos;
                 at = file.text.find(folder, at + 1)) {
                if (at > 0 && continues_a_path(static_cast<unsigned char>(file.text[at - 1]))) {
                    continue;
                }
                const auto line =
                    1 + std::count(file.text.begin(),
                                   file.text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
                found.push_back(file.path + ":" + std::to_string(line) + " names " + folder +
                                ", a folder of one machine.");
            }
        }
    }
    return found;
}

}  // namespace gnomon::layers
