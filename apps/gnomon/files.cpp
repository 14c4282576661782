// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <stb/stb_image_write.h>

namespace gnomon::cli {

namespace {

Status cannot_write(const std::filesystem::path& path, int error) {
    return fail(ErrorCode::Io,
                fmt::format("{} cannot be written: {}.", path.string(), std::strerror(error)));
}

// `path` is how the user calls it.
Status write_bytes(const std::filesystem::path& to, const std::filesystem::path& path,
                   std::span<const std::byte> bytes) {
    std::FILE* file = std::fopen(to.c_str(), "wb");
    if (file == nullptr) return cannot_write(path, errno);
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int error = errno;
    const bool closed = std::fclose(file) == 0;
    if (written && closed) return {};
    return cannot_write(path, written ? errno : error);
}

/// Closes it.
class OpenFile {
public:
    // O_NONBLOCK: a pipe that nobody writes to is opened, and then found to be none of ours.
    explicit OpenFile(const std::filesystem::path& path)
        : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    [[nodiscard]] int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path, std::string_view what,
                              std::size_t most_bytes) {
    const auto cannot_read = [&](int error) {
        return fail(ErrorCode::Io, fmt::format("{}: {} cannot be read: {}.", path.string(), what,
                                               std::strerror(error)));
    };
    const OpenFile file(path);
    if (file.descriptor() < 0) return cannot_read(errno);
    struct stat status {};
    if (::fstat(file.descriptor(), &status) != 0) return cannot_read(errno);
    if (!S_ISREG(status.st_mode)) {
        return fail(ErrorCode::Io,
                    fmt::format("{}: {} must be a plain file, no folder, pipe or device.",
                                path.string(), what));
    }
    const auto too_large = [&](std::uintmax_t bytes) {
        return fail(ErrorCode::Io, fmt::format("{}: {} has {} bytes, but must have {} at most.",
                                               path.string(), what, bytes, most_bytes));
    };
    const auto size = static_cast<std::uintmax_t>(status.st_size);
    if (size > most_bytes) return too_large(size);
    // It may grow meanwhile.
    std::string text(static_cast<std::size_t>(size) + 1, '\0');
    std::size_t read = 0;
    while (true) {
        const ::ssize_t got = ::read(file.descriptor(), text.data() + read, text.size() - read);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return cannot_read(errno);
        if (got == 0) break;
        read += static_cast<std::size_t>(got);
        if (read > most_bytes) return too_large(read);
        if (read == text.size()) text.resize(std::min(2 * text.size(), most_bytes + 1));
    }
    text.resize(read);
    return text;
}

Status check_writable(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) return cannot_write(path, EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        return ::access(path.c_str(), W_OK) == 0 ? Status{} : cannot_write(path, errno);
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    return ::access(folder.c_str(), W_OK | X_OK) == 0 ? Status{} : cannot_write(path, errno);
}

OutputFiles::~OutputFiles() {
    for (const Pending& file : pending_) std::remove(file.temporary.c_str());
}

Status OutputFiles::add(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::error_code error;
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
        return write_bytes(path, path, bytes);
    // A link stays a link: its target is what is replaced.
    std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
    if (error) target = path;
    for (const Pending& other : pending_) {
        if (other.path == target) {
            return fail(
                ErrorCode::InvalidInput,
                fmt::format("{}: two of the files to be written have this name.", path.string()));
        }
    }
    std::filesystem::path temporary = target;
    temporary += fmt::format(".{}.part", ::getpid());
    pending_.push_back({target, temporary});
    return write_bytes(temporary, path, bytes);
}

Status OutputFiles::add(const std::filesystem::path& path, std::string_view text) {
    return add(path, std::as_bytes(std::span(text)));
}

Status OutputFiles::add_png(const std::filesystem::path& path, std::uint32_t width,
                            std::uint32_t height, std::span<const std::byte> rgba) {
    std::vector<std::byte> png;
    const auto append = [](void* context, void* data, int size) {
        auto& out = *static_cast<std::vector<std::byte>*>(context);
        const auto* bytes = static_cast<const std::byte*>(data);
        out.insert(out.end(), bytes, bytes + size);
    };
    const int made =
        stbi_write_png_to_func(append, &png, static_cast<int>(width), static_cast<int>(height), 4,
                               rgba.data(), static_cast<int>(width) * 4);
    if (made == 0) {
        return fail(ErrorCode::OutOfMemory,
                    fmt::format("{}: the PNG could not be encoded.", path.string()));
    }
    return add(path, png);
}

Status OutputFiles::add_pgm(const std::filesystem::path& path, std::uint32_t width,
                            std::uint32_t height, std::span<const std::byte> values) {
    const std::string header = fmt::format("P5\n{} {}\n255\n", width, height);
    std::vector<std::byte> bytes(header.size() + values.size());
    std::memcpy(bytes.data(), header.data(), header.size());
    std::memcpy(bytes.data() + header.size(), values.data(), values.size());
    return add(path, bytes);
}

Status OutputFiles::commit() {
    while (!pending_.empty()) {
        const Pending& file = pending_.back();
        if (std::rename(file.temporary.c_str(), file.path.c_str()) != 0)
            return cannot_write(file.path, errno);
        pending_.pop_back();
    }
    return {};
}

}  // namespace gnomon::cli
