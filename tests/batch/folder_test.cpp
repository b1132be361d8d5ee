// SPDX-License-Identifier: MIT
#include "batch/folder.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::batch {
namespace folder_test {

TEST(Folders, AreMadeWithTheirParents) {
  const TemporaryDirectory directory;
  make_folder(directory / "a/b");
  make_folder(directory / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(directory / "a/b"));
  directory.write("file", "");
  EXPECT_NE(refusal([&] { make_folder(directory / "file/c"); }).find("cannot be made"),
            std::string::npos);
}

TEST(FolderLocks, ExcludeOtherRunsWhileHeld) {
  const TemporaryDirectory directory;
  std::optional<FolderLock> lock(directory.path());
  const auto second = [&] { return refusal([&] { FolderLock other(directory.path()); }); };
  EXPECT_NE(second().find("is in use by another run"), std::string::npos);
  lock.reset();
  EXPECT_NO_THROW(FolderLock(directory.path()));
  EXPECT_NE(refusal([&] { FolderLock none(directory / "missing"); }).find("cannot be written"),
            std::string::npos);
}

}  // namespace folder_test
}  // namespace grove::detail::batch
