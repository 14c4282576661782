// SPDX-License-Identifier: MIT
//
// In the browser: draws every row, at one sample and at four, and leaves the masks in masks.bin.
// masks_test.cpp holds them against Vulkan's and the truth.
#include <cstdio>

#include "tests/support/devices.hpp"
#include "tests/web/row_masks.hpp"

namespace gnomon::test {

static Status draw_all() {
    auto opened = open_device(drawing_devices().front());
    if (!opened) return forward_error(opened);
    TestDevice& device = **opened;
    std::printf("%s\n", device.device.caps().adapter.c_str());
    std::vector<RowMasks> all;
    for (const Row& row : rows()) {
        for (const std::uint32_t samples : {1U, 4U}) {
            auto masks = draw_setting(device.device, row, row.make(), samples);
            if (!masks) {
                return fail(masks.error().code, row.name + ": " + masks.error().message);
            }
            all.push_back(std::move(*masks));
        }
    }
    if (const auto said = device.log->messages(); !said.empty()) {
        return fail(ErrorCode::Internal, said.front().text);
    }
    return write_masks("masks.bin", all);
}

}  // namespace gnomon::test

int main() {
    const gnomon::Status status = gnomon::test::draw_all();
    if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
