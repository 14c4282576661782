// SPDX-License-Identifier: MIT
#include "tests/webgpu/shader_interface.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::test {

namespace {

using Json = nlohmann::json;

// A matrix comes into a vertex stage as its columns.
void add_varying(Interface& lines, const char* direction, unsigned location,
                 const std::string& type) {
    const unsigned columns = type == "mat4" ? 4 : 1;
    for (unsigned i = 0; i < columns; ++i) {
        lines.insert(
            fmt::format("{} {} {}", direction, location + i, columns == 1 ? type : "vec4"));
    }
}

// GLSL, by reflection

void add_members(Interface& lines, const Json& types, const Json& type, const std::string& block,
                 const std::string& prefix) {
    for (const Json& member : type.at("members")) {
        const std::string name = prefix + member.at("name").get<std::string>();
        std::string what = member.at("type");
        const bool is_struct = types.contains(what);
        if (is_struct) what = "struct";
        if (member.contains("array")) {
            what += fmt::format("[{}] every {}", member["array"][0].get<unsigned>(),
                                member.at("array_stride").get<unsigned>());
        }
        lines.insert(
            fmt::format("{} {} {} at {}", block, name, what, member.at("offset").get<unsigned>()));
        if (is_struct) {
            add_members(lines, types, types.at(member.at("type").get<std::string>()), block,
                        name + ".");
        }
    }
}

// WGSL, by the few forms that are written here

struct Member {
    std::string attributes;
    std::string name;
    std::string type;
};

struct Layout {
    unsigned align = 4;
    unsigned size = 4;
};

unsigned round_up(unsigned value, unsigned to) { return (value + to - 1) / to * to; }

class Wgsl {
public:
    explicit Wgsl(std::string text)
        : text_(std::regex_replace(std::move(text), std::regex("//[^\n]*"), "")) {
        const std::regex block(R"(struct\s+(\w+)\s*\{([^}]*)\})");
        for (auto i = std::sregex_iterator(text_.begin(), text_.end(), block);
             i != std::sregex_iterator(); ++i) {
            structs_[(*i)[1]] = members_of((*i)[2]);
        }
    }

    [[nodiscard]] Interface interface() const {
        Interface lines;
        add_bindings(lines);
        add_varyings(lines);
        return lines;
    }

private:
    static std::vector<Member> members_of(const std::string& text) {
        const std::regex member(R"(((?:@\w+(?:\s*\([^)]*\))?\s*)*)(\w+)\s*:\s*(\w+(?:<[^>]*>)?))");
        std::vector<Member> members;
        for (auto i = std::sregex_iterator(text.begin(), text.end(), member);
             i != std::sregex_iterator(); ++i) {
            members.push_back({(*i)[1], (*i)[2], (*i)[3]});
        }
        return members;
    }

    static std::string glsl_type(const std::string& type) {
        static const std::map<std::string, std::string> names{
            {"f32", "float"},   {"u32", "uint"},    {"i32", "int"},     {"vec2f", "vec2"},
            {"vec3f", "vec3"},  {"vec4f", "vec4"},  {"vec2u", "uvec2"}, {"vec3u", "uvec3"},
            {"vec4u", "uvec4"}, {"vec4i", "ivec4"}, {"mat4x4f", "mat4"}};
        const auto found = names.find(type);
        if (found == names.end()) throw std::runtime_error("no GLSL type for " + type);
        return found->second;
    }

    // Rules of WGSL's address space `uniform`.
    Layout layout_of(const std::string& type) const {
        if (type == "f32" || type == "u32" || type == "i32") return {4, 4};
        if (type.starts_with("vec2")) return {8, 8};
        if (type.starts_with("vec3")) return {16, 12};
        if (type.starts_with("vec4")) return {16, 16};
        if (type == "mat4x4f") return {16, 64};
        if (const auto [element, count] = array_of(type); count > 0) {
            return {16, count * round_up(layout_of(element).size, 16)};
        }
        unsigned size = 0;
        for (const Member& member : structs_.at(type)) {
            const Layout layout = layout_of(member.type);
            size = round_up(size, layout.align) + layout.size;
        }
        return {16, round_up(size, 16)};
    }

    static std::pair<std::string, unsigned> array_of(const std::string& type) {
        std::smatch match;
        if (!std::regex_match(type, match, std::regex(R"(array<(\w+),\s*(\d+)>)"))) return {};
        return {match[1], static_cast<unsigned>(std::stoul(match[2]))};
    }

    void add_members(Interface& lines, const std::string& type, const std::string& block,
                     const std::string& prefix) const {
        unsigned offset = 0;
        for (const Member& member : structs_.at(type)) {
            const auto [element, count] = array_of(member.type);
            const std::string& inner = count > 0 ? element : member.type;
            const Layout layout = layout_of(member.type);
            offset = round_up(offset, layout.align);
            const bool is_struct = structs_.contains(inner);
            std::string what = is_struct ? "struct" : glsl_type(inner);
            if (count > 0) {
                what += fmt::format("[{}] every {}", count, round_up(layout_of(inner).size, 16));
            }
            lines.insert(fmt::format("{} {}{} {} at {}", block, prefix, member.name, what, offset));
            if (is_struct) add_members(lines, inner, block, prefix + member.name + ".");
            offset += layout.size;
        }
    }

    void add_bindings(Interface& lines) const {
        const std::regex variable(
            R"(@group\((\d+)\)\s*@binding\((\d+)\)\s*var(<uniform>)?\s+\w+\s*:\s*(\w+)(?:<(\w+)>)?)");
        std::set<std::pair<unsigned, unsigned>> textures;
        std::set<std::pair<unsigned, unsigned>> samplers;
        for (auto i = std::sregex_iterator(text_.begin(), text_.end(), variable);
             i != std::sregex_iterator(); ++i) {
            const std::smatch& m = *i;
            const std::pair place(static_cast<unsigned>(std::stoul(m[1])),
                                  static_cast<unsigned>(std::stoul(m[2])));
            const std::string name = fmt::format("{}.{}", place.first, place.second);
            if (m[3].matched) {
                add_members(lines, m[4], "uniform " + name, "");
            } else if (m[4] == "sampler") {
                samplers.insert(place);
            } else {
                const std::string type = m[4];
                const bool multisampled = type.find("multisampled") != std::string::npos;
                const bool integers = m[5] == "u32";
                if (!multisampled && !integers) textures.insert(place);
                lines.insert(fmt::format("texture {} {}{}", name,
                                         integers ? "usampler2D" : "sampler2D",
                                         multisampled ? "MS" : ""));
            }
        }
        for (const auto& [group, binding] : samplers) {
            if (binding < 100 || !textures.contains({group, binding - 100})) {
                lines.insert(fmt::format("sampler {}.{} without a texture", group, binding));
            }
        }
    }

    void add_varying_of(Interface& lines, const char* direction, const Member& member) const {
        if (const auto found = structs_.find(member.type); found != structs_.end()) {
            for (const Member& inner : found->second) add_varying_of(lines, direction, inner);
            return;
        }
        std::smatch match;
        if (!std::regex_search(member.attributes, match, std::regex(R"(@location\((\d+)\))")))
            return;
        add_varying(lines, direction, static_cast<unsigned>(std::stoul(match[1])),
                    glsl_type(member.type));
    }

    void add_varyings(Interface& lines) const {
        // Attributes of parameters have brackets of their own, so that the closing one is looked
        // for by what follows it.
        const std::regex entry(
            R"(@(?:vertex|fragment)\s+fn\s+main\(([\s\S]*?)\)\s*(?:->\s*([^{]*))?\{)");
        std::smatch match;
        if (!std::regex_search(text_, match, entry)) {
            throw std::runtime_error("no entry point main");
        }
        for (const Member& parameter : members_of(match[1])) add_varying_of(lines, "in", parameter);
        if (!match[2].matched) return;
        // A result has attributes and a type, and no name.
        std::smatch result;
        const std::string text = match[2];
        std::regex_search(text, result, std::regex(R"(((?:@\w+(?:\s*\([^)]*\))?\s*)*)(\w+)\s*$)"));
        add_varying_of(lines, "out", {result[1], "", result[2]});
    }

    std::string text_;
    std::map<std::string, std::vector<Member>> structs_;
};

}  // namespace

Interface interface_of_reflection(const std::string& json) {
    const Json reflection = Json::parse(json);
    const Json types = reflection.value("types", Json::object());
    const auto list = [&](const char* name) { return reflection.value(name, Json::array()); };
    const auto place = [](const Json& resource) {
        return fmt::format("{}.{}", resource.at("set").get<unsigned>(),
                           resource.at("binding").get<unsigned>());
    };
    Interface lines;
    for (const Json& block : list("ubos")) {
        add_members(lines, types, types.at(block.at("type").get<std::string>()),
                    "uniform " + place(block), "");
    }
    for (const Json& texture : list("textures")) {
        lines.insert(
            fmt::format("texture {} {}", place(texture), texture.at("type").get<std::string>()));
    }
    for (const Json& input : list("inputs")) {
        add_varying(lines, "in", input.at("location"), input.at("type"));
    }
    for (const Json& output : list("outputs")) {
        add_varying(lines, "out", output.at("location"), output.at("type"));
    }
    return lines;
}

Interface interface_of_wgsl(std::string text) { return Wgsl(std::move(text)).interface(); }

}  // namespace gnomon::test
