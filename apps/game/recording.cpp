// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <gnomon/core/expects.hpp>

namespace gnomon::game {

namespace {

constexpr std::string_view magic = "gnomon-replay";

std::string letters_of(const Input& input) {
    std::string letters;
    if (input.sneak) letters += 's';
    if (input.run) letters += 'r';
    if (input.restart) letters += 'n';
    if (input.pause) letters += 'p';
    return letters.empty() ? "-" : letters;
}

/// A word for a sentence: no more of it than says which it is, and nothing that a terminal obeys.
std::string printable(std::string_view word) {
    std::string shown(word.substr(0, 70));
    std::ranges::replace_if(
        shown, [](char c) { return c < ' ' || c > '~'; }, '?');
    return shown;
}

/// Line by line, word by word; says where it is.
class Reader {
public:
    Reader(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

    /// The words of the next line; nothing at the end.
    std::optional<std::vector<std::string_view>> line() {
        if (rest_.empty()) return std::nullopt;
        ++number_;
        const std::size_t end = rest_.find('\n');
        std::string_view text = rest_.substr(0, end);
        rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
        if (text.ends_with('\r')) text.remove_suffix(1);
        std::vector<std::string_view> words;
        while (!text.empty()) {
            const std::size_t begin = text.find_first_not_of(' ');
            if (begin == std::string_view::npos) break;
            text.remove_prefix(begin);
            words.push_back(text.substr(0, text.find(' ')));
            text.remove_prefix(words.back().size());
        }
        return words;
    }

    [[nodiscard]] tl::unexpected<Error> refuse(const std::string& what) const {
        return fail(ErrorCode::InvalidInput, fmt::format("{}:{}: {}.", file_, number_, what));
    }

    [[nodiscard]] Result<int> number(std::string_view word, const char* name, int min,
                                     int max) const {
        int value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool whole = error == std::errc{} && end == word.data() + word.size();
        if (!whole || value < min || value > max) {
            return refuse(fmt::format("{} is \"{}\", but must be a whole number from {} to {}",
                                      name, printable(word), min, max));
        }
        return value;
    }

private:
    std::string_view rest_;
    const std::string& file_;
    std::size_t number_ = 0;
};

Result<Input> input_of(const Reader& reader, const std::vector<std::string_view>& words) {
    const auto east = reader.number(words[1], "east", -127, 127);
    if (!east) return forward_error(east);
    const auto south = reader.number(words[2], "south", -127, 127);
    if (!south) return forward_error(south);
    Input input{.east = static_cast<std::int8_t>(*east), .south = static_cast<std::int8_t>(*south)};
    if (words[3] == "-") return input;
    for (const char letter : words[3]) {
        bool* held = nullptr;
        if (letter == 's') held = &input.sneak;
        if (letter == 'r') held = &input.run;
        if (letter == 'n') held = &input.restart;
        if (letter == 'p') held = &input.pause;
        if (held == nullptr || *held) {
            return reader.refuse(
                fmt::format("\"{}\" is not made of the letters s, r, n and p, "
                            "each at most once, nor is it -",
                            printable(words[3])));
        }
        *held = true;
    }
    return input;
}

/// The value of a line "name value".
Result<std::string> header(Reader& reader, std::string_view name) {
    const auto words = reader.line();
    if (!words || words->size() != 2 || words->front() != name) {
        return reader.refuse(fmt::format("here must be \"{}\" and a value", name));
    }
    return std::string((*words)[1]);
}

}  // namespace

bool is_level_name(std::string_view name) {
    constexpr std::string_view allowed =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    return !name.empty() && name.size() <= 60 &&
           name.find_first_not_of(allowed) == std::string_view::npos;
}

std::string to_text(const Recording& recording) {
    GNOMON_EXPECTS(is_level_name(recording.level));
    GNOMON_EXPECTS(recording.inputs.size() <= most_ticks);
    std::string text =
        fmt::format("{} 1\nlevel {}\nticks {}\n", magic, recording.level, recording.inputs.size());
    for (std::size_t i = 0; i < recording.inputs.size();) {
        const Input& input = recording.inputs[i];
        std::size_t same = i + 1;
        while (same < recording.inputs.size() && recording.inputs[same] == input) ++same;
        text += fmt::format("{} {} {} {}\n", same - i, input.east, input.south, letters_of(input));
        i = same;
    }
    return text + "end\n";
}

Result<Recording> read_recording(std::string_view text, const std::string& file) {
    Reader reader(text, file);
    const auto version = header(reader, magic);
    if (!version) return forward_error(version);
    if (*version != "1") {
        return reader.refuse(
            fmt::format("the version is \"{}\", but this program reads 1", printable(*version)));
    }
    Recording recording;
    auto level = header(reader, "level");
    if (!level) return forward_error(level);
    if (!is_level_name(*level)) {
        return reader.refuse(
            fmt::format("the level is \"{}\", but must be 1 to 60 letters, digits, \"-\" or \"_\"",
                        printable(*level)));
    }
    recording.level = std::move(*level);
    const auto ticks_word = header(reader, "ticks");
    if (!ticks_word) return forward_error(ticks_word);
    const auto ticks = reader.number(*ticks_word, "ticks", 0, static_cast<int>(most_ticks));
    if (!ticks) return forward_error(ticks);
    const auto wanted = static_cast<std::size_t>(*ticks);

    while (true) {
        const auto words = reader.line();
        if (!words) return reader.refuse("the recording breaks off; its last line must be \"end\"");
        if (words->size() == 1 && words->front() == "end") break;
        if (words->size() != 4) {
            return reader.refuse(
                fmt::format("the line has {} words, but must have 4: ticks, east, south, letters",
                            words->size()));
        }
        const auto count =
            reader.number(words->front(), "the number of ticks", 1, static_cast<int>(most_ticks));
        if (!count) return forward_error(count);
        const auto input = input_of(reader, *words);
        if (!input) return forward_error(input);
        if (recording.inputs.size() + static_cast<std::size_t>(*count) > wanted) {
            return reader.refuse(
                fmt::format("there is input for more than the {} ticks that the "
                            "recording is said to have",
                            wanted));
        }
        recording.inputs.insert(recording.inputs.end(), static_cast<std::size_t>(*count), *input);
    }
    if (recording.inputs.size() != wanted) {
        return reader.refuse(
            fmt::format("there is input for {} ticks, but the recording is said to have {}",
                        recording.inputs.size(), wanted));
    }
    if (reader.line()) {
        return reader.refuse("here is a line after the line \"end\", but that must be the last");
    }
    return recording;
}

}  // namespace gnomon::game
