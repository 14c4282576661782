// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/input/script.hpp>

namespace gnomon::input {

namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::uint64_t most_frames = 1'000'000;
/// Farther than any screen reaches, in pixels; notches of a wheel in one frame.
constexpr double farthest_px = 1e6;
constexpr double most_notches = 1000.0;

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

// Takes the first word off `text`.
std::string_view take_word(std::string_view& text) {
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text = trimmed(text.substr(word.size()));
    return word;
}

// Without its comment: a '#' within a word, as in a file's name, begins none.
std::string_view without_comment(std::string_view line) {
    for (std::size_t at = line.find('#'); at != std::string_view::npos;
         at = line.find('#', at + 1)) {
        if (at == 0 || blanks.find(line[at - 1]) != std::string_view::npos) {
            return line.substr(0, at);
        }
    }
    return line;
}

template <class Number>
bool parse_whole(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

bool parse_finite(std::string_view text, double& number) {
    return parse_whole(text, number) && std::isfinite(number);
}

std::u32string from_utf8(std::string_view text) {
    std::u32string out;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
        char32_t value = length == 1 ? lead : lead & (0x7FU >> length);
        for (std::size_t k = 1; k < length && i + k < text.size(); ++k) {
            value = value << 6U | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
        }
        out.push_back(value);
        i += length;
    }
    return out;
}

}  // namespace

struct Script::Line {
    std::string place;  ///< "file:line"
    std::uint64_t frame = 0;
    std::string_view word = {};
    std::string_view rest = {};

    [[nodiscard]] tl::unexpected<Error> wrong(std::string_view what) const {
        return fail(ErrorCode::InvalidInput, fmt::format("{}: {}", place, what));
    }
};

Status Script::read_press(const Line& line) {
    Event event{.frame = line.frame};
    const bool releases = line.word == "release";
    if (const auto button = mouse_button_named(line.rest)) {
        event.kind = releases ? Kind::ReleaseButton : Kind::PressButton;
        event.button = *button;
    } else if (const auto key = key_named(line.rest)) {
        event.kind = releases ? Kind::ReleaseKey : Kind::PressKey;
        event.key = *key;
    } else {
        return line.wrong(fmt::format(
            "\"{}\" is neither a mouse button (left, right, middle) nor a key.", line.rest));
    }
    events_.push_back(event);
    if (line.word == "tap" || line.word == "click") {
        event.kind = event.kind == Kind::PressKey ? Kind::ReleaseKey : Kind::ReleaseButton;
        ++event.frame;
        events_.push_back(event);
    }
    return {};
}

Status Script::read(const Line& line, std::span<const std::string_view> commands,
                    const CommandCheck& check) {
    Event event{.frame = line.frame};
    if (line.word == "press" || line.word == "release" || line.word == "tap" ||
        line.word == "click") {
        return read_press(line);
    }
    if (line.word == "move") {
        event.kind = Kind::Move;
        std::string_view rest = line.rest;
        const std::string_view x = take_word(rest);
        if (!parse_finite(x, event.numbers.x) || !parse_finite(rest, event.numbers.y)) {
            return line.wrong(fmt::format("move takes two numbers, not \"{}\".", line.rest));
        }
        if (std::max(std::abs(event.numbers.x), std::abs(event.numbers.y)) > farthest_px) {
            return line.wrong(fmt::format("move to \"{}\": each is at most {} pixels from 0.",
                                          line.rest, static_cast<int>(farthest_px)));
        }
    } else if (line.word == "scroll") {
        event.kind = Kind::Scroll;
        if (!parse_finite(line.rest, event.numbers.y)) {
            return line.wrong(fmt::format("scroll takes a number, not \"{}\".", line.rest));
        }
        if (std::abs(event.numbers.y) > most_notches) {
            return line.wrong(fmt::format("scroll by \"{}\": at most {} notches either way.",
                                          line.rest, static_cast<int>(most_notches)));
        }
    } else if (line.word == "type" || line.word == "drop") {
        event.kind = line.word == "type" ? Kind::Type : Kind::Drop;
        event.text = line.rest;
        if (event.text.empty()) return line.wrong(fmt::format("{} what?", line.word));
    } else if (line.word == "unfocus") {
        event.kind = Kind::Unfocus;
    } else if (line.word == "close") {
        event.kind = Kind::Close;
    } else if (std::ranges::find(commands, line.word) != commands.end()) {
        event.kind = Kind::Command;
        event.text =
            line.rest.empty() ? std::string(line.word) : fmt::format("{} {}", line.word, line.rest);
        if (check) {
            if (const Status right = check(event.text); !right) {
                return line.wrong(right.error().message);
            }
        }
    } else {
        std::vector<std::string_view> known{"move",   "press", "release", "tap",     "click",
                                            "scroll", "type",  "drop",    "unfocus", "close"};
        known.insert(known.end(), commands.begin(), commands.end());
        return line.wrong(fmt::format("there is no event \"{}\"; there are {}.", line.word,
                                      fmt::join(known, ", ")));
    }
    events_.push_back(std::move(event));
    return {};
}

Result<Script> Script::parse(std::string_view text, std::string_view file_name,
                             std::span<const std::string_view> commands,
                             const CommandCheck& check) {
    Script script;
    std::uint64_t before = 0;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        std::string_view rest = trimmed(without_comment(text.substr(0, end)));
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
        if (rest.empty()) continue;
        Line line{.place = fmt::format("{}:{}", file_name, number)};
        const std::string_view frame = take_word(rest);
        if (!parse_whole(frame, line.frame) || line.frame > most_frames) {
            return line.wrong(fmt::format("\"{}\" is no frame from 0 to {}.", frame, most_frames));
        }
        if (line.frame < before) {
            return line.wrong(fmt::format("frame {} comes after frame {}.", line.frame, before));
        }
        before = line.frame;
        line.word = take_word(rest);
        line.rest = rest;
        if (const Status read = script.read(line, commands, check); !read)
            return forward_error(read);
    }
    std::ranges::stable_sort(script.events_, {}, &Event::frame);
    return script;
}

void Script::play(std::uint64_t frame, Input& input) {
    for (; next_ < events_.size() && events_[next_].frame <= frame; ++next_) {
        const Event& event = events_[next_];
        switch (event.kind) {
            case Kind::Move: input.move_cursor(event.numbers); break;
            case Kind::PressKey: input.press(event.key); break;
            case Kind::ReleaseKey: input.release(event.key); break;
            case Kind::PressButton: input.press(event.button); break;
            case Kind::ReleaseButton: input.release(event.button); break;
            case Kind::Scroll: input.scroll += event.numbers; break;
            case Kind::Type: input.text += from_utf8(event.text); break;
            case Kind::Drop: input.dropped_files.push_back(event.text); break;
            case Kind::Unfocus: input.lose_focus(); break;
            case Kind::Close: input.close_requested = true; break;
            case Kind::Command: input.commands.push_back(event.text); break;
        }
    }
}

std::uint64_t Script::last_frame() const { return events_.empty() ? 0 : events_.back().frame; }

}  // namespace gnomon::input
