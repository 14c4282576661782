// SPDX-License-Identifier: MIT
#include "truth_job.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace gnomon::web {

namespace {

constexpr std::uint32_t mark = 0x31746e67;  // "gnt1"
constexpr std::uint32_t largest_side = 8192;

class Writer {
public:
    template <class Value>
    void put(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        append(&value, sizeof value);
    }
    template <class Value>
    void put_all(const std::vector<Value>& values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        put(static_cast<std::uint32_t>(values.size()));
        if (!values.empty()) append(values.data(), values.size() * sizeof(Value));
    }
    std::vector<std::uint8_t> bytes;

private:
    void append(const void* data, std::size_t size) {
        const auto* begin = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), begin, begin + size);
    }
};

/// Gives zeros once the bytes are used up; good() says that they were.
class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    template <class Value>
    Value get() {
        static_assert(std::is_trivially_copyable_v<Value>);
        Value value{};
        if (take(sizeof value)) std::memcpy(&value, taken_.data(), sizeof value);
        return value;
    }
    template <class Value>
    std::vector<Value> get_all() {
        const std::size_t count = get<std::uint32_t>();
        if (count > rest_.size() / sizeof(Value)) {
            good_ = false;
            return {};
        }
        std::vector<Value> values(count);
        if (count > 0 && take(count * sizeof(Value))) {
            std::memcpy(values.data(), taken_.data(), taken_.size());
        }
        return values;
    }
    [[nodiscard]] bool good() const { return good_; }
    [[nodiscard]] bool at_end() const { return good_ && rest_.empty(); }

private:
    bool take(std::size_t size) {
        good_ = good_ && size <= rest_.size();
        if (!good_) return false;
        taken_ = rest_.first(size);
        rest_ = rest_.subspan(size);
        return true;
    }
    std::span<const std::uint8_t> rest_;
    std::span<const std::uint8_t> taken_;
    bool good_ = true;
};

/// As bytes: shadows::Light has gaps.
struct LightRecord {
    glm::dvec4 position{0.0};
    double range_m = 0.0;  // not a number: none
};

tl::unexpected<Error> bad(std::string_view what) {
    return fail(ErrorCode::InvalidInput, fmt::format("A job for the truth {}.", what));
}

}  // namespace

std::vector<truth::Instance> TruthJob::instances() const {
    std::vector<truth::Instance> instances;
    for (const Mesh& mesh : meshes) {
        instances.push_back(
            {mesh.positions, mesh.indices, mesh.world_from_local, mesh.casts, mesh.receives});
    }
    return instances;
}

TruthJob job_of(std::span<const truth::Instance> instances) {
    TruthJob job;
    for (const truth::Instance& instance : instances) {
        job.meshes.push_back({{instance.positions.begin(), instance.positions.end()},
                              {instance.indices.begin(), instance.indices.end()},
                              instance.world_from_local,
                              instance.casts,
                              instance.receives});
    }
    return job;
}

std::vector<std::uint8_t> write_job(const TruthJob& job) {
    Writer out;
    out.put(mark);
    out.put(job.width);
    out.put(job.height);
    out.put(job.samples);
    out.put(job.band_px);
    out.put(job.view.view_from_world);
    out.put(job.view.clip_from_view);
    out.put(static_cast<std::uint32_t>(job.view.projection));
    out.put(static_cast<std::uint32_t>(job.lights.size()));
    for (const shadows::Light& light : job.lights) {
        out.put(LightRecord{light.position_world, light.range_m.value_or(std::nan(""))});
    }
    out.put(static_cast<std::uint32_t>(job.meshes.size()));
    for (const TruthJob::Mesh& mesh : job.meshes) {
        out.put(mesh.world_from_local);
        out.put((mesh.casts ? 1U : 0U) | (mesh.receives ? 2U : 0U));
        out.put_all(mesh.positions);
        out.put_all(mesh.indices);
    }
    return std::move(out.bytes);
}

Result<TruthJob> read_job(std::span<const std::uint8_t> bytes) {
    Reader in(bytes);
    if (in.get<std::uint32_t>() != mark) return bad("begins otherwise than one");
    TruthJob job;
    job.width = in.get<std::uint32_t>();
    job.height = in.get<std::uint32_t>();
    job.samples = in.get<std::uint32_t>();
    job.band_px = in.get<double>();
    job.view.view_from_world = in.get<glm::dmat4>();
    job.view.clip_from_view = in.get<glm::dmat4>();
    const auto projection = in.get<std::uint32_t>();
    job.view.projection = static_cast<shadows::ProjectionKind>(projection);
    if (job.width == 0 || job.width > largest_side || job.height == 0 ||
        job.height > largest_side) {
        return bad(fmt::format("is of {} x {} pixels; the limit is {} each", job.width, job.height,
                               largest_side));
    }
    if (job.samples != 1 && job.samples != 4) {
        return bad(fmt::format("has {} samples a pixel instead of 1 or 4", job.samples));
    }
    if (!(job.band_px >= 0.0 && job.band_px <= 1.0)) {
        return bad(fmt::format("has a band of {} pixels, which is not from 0 to 1", job.band_px));
    }
    if (projection > static_cast<std::uint32_t>(shadows::ProjectionKind::Orthographic)) {
        return bad(fmt::format("has projection {}, which there is not", projection));
    }
    for (auto left = in.get<std::uint32_t>(); left > 0 && in.good(); --left) {
        const auto record = in.get<LightRecord>();
        shadows::Light& light = job.lights.emplace_back();
        light.position_world = record.position;
        if (!std::isnan(record.range_m)) light.range_m = record.range_m;
    }
    for (auto left = in.get<std::uint32_t>(); left > 0 && in.good(); --left) {
        TruthJob::Mesh& mesh = job.meshes.emplace_back();
        mesh.world_from_local = in.get<glm::dmat4>();
        const auto flags = in.get<std::uint32_t>();
        mesh.casts = (flags & 1U) != 0;
        mesh.receives = (flags & 2U) != 0;
        mesh.positions = in.get_all<glm::vec3>();
        mesh.indices = in.get_all<std::uint32_t>();
    }
    if (!in.at_end()) return bad(in.good() ? "goes on after its end" : "ends too early");
    return job;
}

glm::dvec2 sample_position(std::uint32_t sample, std::uint32_t samples) {
    constexpr std::array<glm::dvec2, 4> places_of_four{
        {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
    return samples == 4 ? places_of_four.at(sample) : glm::dvec2(0.5);
}

TruthBench::TruthBench(TruthJob job, truth::Tracer tracer)
    : job_(std::move(job)), tracer_(std::move(tracer)) {}

Result<TruthBench> TruthBench::create(std::span<const std::uint8_t> bytes) {
    auto job = read_job(bytes);
    if (!job) return forward_error(job);
    const glm::dvec3 eye(glm::inverse(job->view.view_from_world)[3]);
    auto tracer = truth::Tracer::build(job->instances(), eye);
    if (!tracer) return forward_error(tracer);
    return TruthBench(std::move(*job), std::move(*tracer));
}

Result<std::vector<truth::Judgement>> TruthBench::judge(std::uint32_t first_row, std::uint32_t rows,
                                                        std::span<const std::uint8_t> masks) const {
    if (first_row >= job_.height || rows == 0 || rows > job_.height - first_row) {
        return bad(
            fmt::format("has {} rows, so not {} from row {} on", job_.height, rows, first_row));
    }
    const std::size_t of_rows = std::size_t{job_.width} * rows;
    const std::size_t of_one = of_rows * job_.samples * job_.lights.size();
    if (of_one == 0 || masks.empty() || masks.size() % of_one != 0) {
        return bad(fmt::format("has {} bytes of masks for {} rows, of which a technique has {}",
                               masks.size(), rows, of_one));
    }
    std::vector<truth::Judgement> judgements(masks.size() / of_one);
    for (std::size_t light = 0; light < job_.lights.size(); ++light) {
        for (std::uint32_t sample = 0; sample < job_.samples; ++sample) {
            const truth::Picture truth =
                tracer_.trace(job_.view, job_.lights[light],
                              {.width = job_.width,
                               .height = job_.height,
                               .first_row = first_row,
                               .rows = rows,
                               .band_px = job_.band_px,
                               .sample_position = sample_position(sample, job_.samples)});
            for (std::size_t technique = 0; technique < judgements.size(); ++technique) {
                const std::size_t mask =
                    technique * of_one + (light * job_.samples + sample) * of_rows;
                truth::Judgement judged = truth::judge(truth, masks.subspan(mask, of_rows));
                for (std::uint32_t& pixel : judged.wrong_pixels) pixel += first_row * job_.width;
                judgements[technique] += judged;
            }
        }
    }
    return judgements;
}

}  // namespace gnomon::web
