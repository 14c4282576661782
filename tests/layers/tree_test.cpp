// SPDX-License-Identifier: MIT
//
// The rules on the repository itself.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/layers/rules.hpp"
#include "tests/support/paths.hpp"

namespace gnomon::layers {
namespace {

using testing::IsEmpty;

class Repository : public testing::Test {
protected:
    static void SetUpTestSuite() { tree_ = read_tree(test::source_folder()); }
    static std::vector<SourceFile> tree_;
};
std::vector<SourceFile> Repository::tree_;

TEST_F(Repository, IsRead) {
    const auto holds = [&](std::string_view path) {
        return std::ranges::any_of(tree_, [&](const SourceFile& f) { return f.path == path; });
    };
    EXPECT_TRUE(holds("modules/core/result.hpp"));
    EXPECT_TRUE(holds("modules/shadows/internal/pair.hpp"));
    EXPECT_TRUE(holds("tests/layers/tree_test.cpp"));
    EXPECT_FALSE(std::ranges::any_of(
        tree_, [](const SourceFile& f) { return f.path.starts_with(".git/"); }));
}

TEST_F(Repository, IncludesRunOneWay) { EXPECT_THAT(check_includes(tree_), IsEmpty()); }
TEST_F(Repository, OneFileChoosesTheBackend) {
    EXPECT_THAT(check_backend_choice(tree_), IsEmpty());
}
TEST_F(Repository, FilesAreShort) { EXPECT_THAT(check_lengths(tree_), IsEmpty()); }
TEST_F(Repository, FilesNameTheirLicence) { EXPECT_THAT(check_licence_lines(tree_), IsEmpty()); }
TEST_F(Repository, PublicHeadersAreSeenFromOutside) {
    EXPECT_THAT(check_visibility(tree_), IsEmpty());
}
TEST_F(Repository, NamesNoMachine) { EXPECT_THAT(check_machine_paths(tree_), IsEmpty()); }

}  // namespace
}  // namespace gnomon::layers
