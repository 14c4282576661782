// SPDX-License-Identifier: MIT
//
// Runs of gnomon profile on a small site: a tower and a shed.
#pragma once

#include "tests/cli/program.hpp"

namespace gnomon::cli::test {

/// Of one day at the site, hour by hour, into the folder `out`.
[[nodiscard]] Arguments profile(const std::string& out, const Arguments& more = {});

class Profile : public ProgramTest {
protected:
    void SetUp() override;
    [[nodiscard]] nlohmann::json summary(const std::string& folder) const;
    /// Unpacked as NumPy would: rows of ones and zeros.
    [[nodiscard]] std::vector<std::string> mask(const std::string& file, std::size_t columns,
                                                std::size_t rows) const;
    /// All files of `a` are in `b`, and the same.
    void expect_same_files(const std::string& a, const std::string& b) const;
};

}  // namespace gnomon::cli::test
