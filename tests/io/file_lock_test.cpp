// SPDX-License-Identifier: MIT
#include "io/file_lock.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "io/text_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace file_lock_test {

std::string locking(const std::string& path) {
  return refusal([&] { const FileLock lock(path); });
}

TEST(FileLock, ExcludesOthersAndNamesItsHolder) {
  const TemporaryDirectory directory;
  FileLock lock(directory / "lock");
  EXPECT_TRUE(lock.is_held());
  const std::string message = locking(directory / "lock");
  EXPECT_TRUE(message.starts_with("lock: is locked by another run (process " +
                                  std::to_string(::getpid()) + " on host "))
      << message;
  EXPECT_EQ(locking(directory / "other"), "accepted");
}

TEST(FileLock, IsReleasedByItsDestructor) {
  const TemporaryDirectory directory;
  {
    FileLock first(directory / "lock");
    const FileLock moved = std::move(first);
    EXPECT_NE(locking(directory / "lock"), "accepted");
  }
  EXPECT_EQ(locking(directory / "lock"), "accepted");
}

TEST(FileLock, IsNotTakenThroughLinks) {
  const TemporaryDirectory directory;
  const std::filesystem::path victim = directory.write("victim", "precious");
  std::filesystem::create_symlink(victim, directory / "link");
  std::filesystem::create_hard_link(victim, directory / "twin");
  std::filesystem::create_symlink(directory / "none", directory / "dangling");
  for (const char* name : {"link", "twin", "dangling"})
    EXPECT_EQ(locking(directory / name),
              std::string(name) + ": is a link or not a regular file; expected a lock file");
  EXPECT_FALSE(std::filesystem::exists(directory / "none"));
  EXPECT_EQ(read_text(victim), "precious");
}

TEST(OutputLock, ExcludesOthersAndLeavesNoFiles) {
  const TemporaryDirectory directory;
  const auto locking_output = [](const std::string& path) {
    return refusal([&] { const OutputLock lock(path); });
  };
  directory.write("plan.json", "{}");
  std::filesystem::create_symlink("plan.json", directory / "link");
  {
    const OutputLock lock(directory / "plan.json");
    for (const char* name : {"plan.json", "link"})
      EXPECT_TRUE(locking_output(directory / name)
                      .starts_with(std::string(name) +
                                   ": is being written by another run (process " +
                                   std::to_string(::getpid())))
          << locking_output(directory / name);
    EXPECT_EQ(locking_output(directory / "other.json"), "accepted");
  }
  EXPECT_EQ(locking_output(directory / "plan.json"), "accepted");
  EXPECT_EQ(locking_output("/dev/null"), "accepted");
  EXPECT_EQ(locking_output(directory / "none/plan.json"), "accepted");  // the write will fail
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
    files += entry.path().filename() != "link" && entry.path().filename() != "plan.json";
  EXPECT_EQ(files, 0U);
}

// Only the kernel releases the lock of a killed process.
TEST(FileLock, IsReleasedWhenItsProcessIsKilled) {
  const TemporaryDirectory directory;
  const pid_t process = ::fork();
  if (process == 0) {
    const FileLock lock(directory / "lock");
    for (;;) ::pause();
  }
  const std::filesystem::path file = directory / "lock";
  // Wait until the holder has written its name.
  while (!std::filesystem::exists(file) || std::filesystem::is_empty(file))
    std::this_thread::yield();
  EXPECT_NE(locking(file), "accepted");
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  EXPECT_EQ(locking(directory / "lock"), "accepted");
}

TEST(FileLock, RefusesAFileThatCannotBeWritten) {
  const TemporaryDirectory directory;
  EXPECT_EQ(locking(directory / "none/lock"), "lock: cannot be written: No such file or directory");
}

}  // namespace file_lock_test
}  // namespace grove::detail
