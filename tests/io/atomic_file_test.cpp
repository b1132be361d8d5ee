// SPDX-License-Identifier: MIT
#include "io/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/file_size_limit.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace atomic_file_test {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

std::string writing_content(const std::string& path, const std::string& content) {
  return refusal([&] { write_file_atomically(path, content); });
}

std::string writing(const std::string& path) {
  return writing_content(path, "new");
}

std::string checking_writable(const std::string& path) {
  return refusal([&] { require_writable(path); });
}

TEST(WriteFileAtomically, MakesAndReplacesFiles) {
  const TemporaryDirectory directory;
  write_file_atomically(directory / "file", "old");
  write_file_atomically(directory / "file", "new");
  EXPECT_EQ(file_content(directory / "file"), "new");
  EXPECT_EQ(directory.files(), Names{"file"});
}

TEST(WriteFileAtomically, WritesIntoTheCurrentFolder) {
  const TemporaryDirectory directory;
  const fs::path before = fs::current_path();
  fs::current_path(directory.path());
  write_file_atomically("bare", "new");
  fs::current_path(before);
  EXPECT_EQ(file_content(directory / "bare"), "new");
}

TEST(WriteFileAtomically, KeepsPermissionsAndFollowsLinks) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("file", "old");
  ::chmod(file.c_str(), 0640);
  fs::create_symlink("file", directory / "link");
  write_file_atomically(directory / "link", "new");
  EXPECT_TRUE(fs::is_symlink(directory / "link"));
  EXPECT_EQ(file_content(file), "new");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
}

TEST(WriteFileAtomically, RefusesUnwritablePaths) {
  const TemporaryDirectory directory;
  directory.write("file", "old");
  for (auto* result : {writing, checking_writable}) {
    EXPECT_EQ(result(directory / "missing/file"),
              "file: cannot be written: No such file or directory");
    EXPECT_EQ(result(directory / "file/file"), "file: cannot be written: Not a directory");
    EXPECT_EQ(result(directory.path()),
              directory.path().filename().string() + ": is a directory; expected a file name");
    EXPECT_NE(result(""), "accepted");
    EXPECT_NE(result(directory / "missing/"), "accepted");
    EXPECT_NE(result(directory / std::string(300, 'x')), "accepted");
  }
  EXPECT_EQ(directory.files(), Names{"file"});
  EXPECT_EQ(file_content(directory / "file"), "old");
}

// During its lifetime a test that root runs has the rights of an unprivileged user.
class UnprivilegedUser {
 public:
  UnprivilegedUser() : was_root_(::geteuid() == 0) {
    if (was_root_ && ::seteuid(65534) != 0) ADD_FAILURE() << "seteuid";
  }
  ~UnprivilegedUser() {
    if (was_root_ && ::seteuid(0) != 0) ADD_FAILURE() << "seteuid";
  }

 private:
  bool was_root_;
};

TEST(WriteFileAtomically, RefusesWithoutPermission) {
  const TemporaryDirectory directory;
  ::chmod(directory.write("file", "old").c_str(), 0444);
  ::chmod(directory.path().c_str(), 0777);
  {
    const UnprivilegedUser user;
    EXPECT_EQ(writing(directory / "file"), "file: cannot be written: Permission denied");
    EXPECT_EQ(checking_writable(directory / "file"), "file: cannot be written: Permission denied");
    EXPECT_EQ(checking_writable(directory / "other"), "accepted");
  }
  ::chmod(directory.path().c_str(), 0555);
  {
    const UnprivilegedUser user;
    EXPECT_EQ(writing(directory / "other"), "other: cannot be written: Permission denied");
    EXPECT_EQ(checking_writable(directory / "other"),
              "other: cannot be written: Permission denied");
  }
  ::chmod(directory.path().c_str(), 0755);
}

TEST(WriteFileAtomically, WritesSpecialFilesDirectly) {
  EXPECT_EQ(writing("/dev/null"), "accepted");
  EXPECT_EQ(checking_writable("/dev/null"), "accepted");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(writing("/dev/full"), "full: cannot be written: No space left on device");
}

TEST(WriteFileAtomically, KeepsTheOldFileWhenTheDiskIsFull) {
  const TemporaryDirectory directory;
  directory.write("file", "old");
  std::string result;
  {
    const FileSizeLimit limit(1000);
    result = writing_content(directory / "file", std::string(5000, 'x'));
  }
  EXPECT_EQ(result, "file: cannot be written: File too large");
  EXPECT_EQ(file_content(directory / "file"), "old");
  EXPECT_EQ(directory.files(), Names{"file"});
}

// A process that writes half of `file` and then waits to be killed.
class Writer {
 public:
  explicit Writer(const std::string& file) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    process_ = ::fork();
    if (process_ == 0) {
      AtomicFile half(file);
      half.write("half");
      std::ignore = ::write(ends[1], "!", 1);
      for (;;) ::pause();
    }
    ::close(ends[1]);
    char result = 0;
    EXPECT_EQ(::read(ends[0], &result, 1), 1);
    ::close(ends[0]);
  }
  ~Writer() { kill(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  pid_t process_ = -1;
};

// Returns the name of a half-written file other than `other`; "" if there is none.
std::string half_written(const TemporaryDirectory& directory, const std::string& other) {
  for (const std::string& name : directory.files())
    if (name != other && file_content(directory / name) == "half") return name;
  return "";
}

TEST(WriteFileAtomically, RemovesTemporaryFilesOfKilledProcesses) {
  const TemporaryDirectory directory;
  Writer killed(directory / "file");
  const std::string left = half_written(directory, "");
  killed.kill();
  EXPECT_EQ(directory.files(), Names{left});
  const Writer alive(directory / "file");
  const std::string live = half_written(directory, left);
  write_file_atomically(directory / "other", "new");
  EXPECT_EQ(directory.files(), (Names{live, "other"}));
}

// Some file systems do not show whether another host has locked a file, so the age of the file
// decides.
TEST(WriteFileAtomically, RemovesOldTemporaryFilesOfOtherHosts) {
  const TemporaryDirectory directory;
  directory.write(".grove-1-1-1@elsewhere.tmp", "half");
  const std::string old = directory.write(".grove-1-1-2@elsewhere.tmp", "half");
  directory.write(".grove-mine", "");
  fs::last_write_time(old, fs::last_write_time(old) - std::chrono::hours(2));
  write_file_atomically(directory / "file", "new");
  EXPECT_EQ(directory.files(), (Names{".grove-1-1-1@elsewhere.tmp", ".grove-mine", "file"}));
}

TEST(FlushFile, RefusesMissingFiles) {
  const TemporaryDirectory directory;
  write_file_atomically(directory / "file", "new", Durability::kProcess);
  EXPECT_EQ(refusal([&] { flush_file(directory / "file"); }), "accepted");
  EXPECT_EQ(refusal([&] { flush_file(directory / "none"); }),
            "none: cannot be written: No such file or directory");
}

TEST(AtomicFile, ReplacesTheFileOnCommit) {
  const TemporaryDirectory directory;
  directory.write("file", "old");
  AtomicFile file(directory / "file");
  file.write("new");
  file.write(" pieces");
  EXPECT_EQ(file_content(directory / "file"), "old");
  file.commit();
  EXPECT_EQ(file_content(directory / "file"), "new pieces");
  EXPECT_EQ(directory.files(), Names{"file"});
}

TEST(AtomicFile, LeavesNothingBehindUnlessCommitted) {
  const TemporaryDirectory directory;
  directory.write("file", "old");
  {
    AtomicFile file(directory / "file");
    file.write("new");
    EXPECT_EQ(directory.files().size(), 2u);
  }
  EXPECT_EQ(file_content(directory / "file"), "old");
  EXPECT_EQ(directory.files(), Names{"file"});
}

TEST(RequireWritable, LeavesNothingBehind) {
  const TemporaryDirectory directory;
  EXPECT_EQ(checking_writable(directory / "new"), "accepted");
  EXPECT_TRUE(directory.files().empty());
}

}  // namespace atomic_file_test
}  // namespace grove::detail
