// SPDX-License-Identifier: MIT
#include "tools/bench/child_process.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace grove::detail::bench {
namespace child_process_test {

class Children : public ::testing::Test {
 protected:
  ChildEnd run(const std::string& script, bool cancelled = false) {
    return run_child({"/bin/sh", "-c", script}, directory_ / "said",
                     {.seconds = 60,
                      .cancelled = [cancelled] { return cancelled; },
                      .clock = [this] { return now_; }});
  }
  // Runs a child that ends at the third poll, with polls `seconds` / 3 apart, and returns how it
  // ended.
  ChildEnd run_for(double seconds) {
    const std::string go = directory_ / "go";
    EXPECT_EQ(::mkfifo(go.c_str(), 0600), 0);
    int looks = 0;
    const auto look = [&] {
      now_ += seconds / 3;
      if (++looks == 3) std::ofstream(go) << "!\n";
      return false;
    };
    ChildEnd end = run_child({"/bin/sh", "-c", "read line < '" + go + "'"}, directory_ / "said",
                             {.seconds = 60, .cancelled = look, .clock = [this] { return now_; }});
    std::filesystem::remove(go);
    return end;
  }

  TemporaryDirectory directory_;
  double now_ = 1000;
};

constexpr const char* kWithoutEnd = "exec sleep 600";

TEST_F(Children, ReportExitCodeAndSignal) {
  ChildEnd end = run("exit 3");
  EXPECT_EQ(end.kind, ChildEnd::Kind::kExited);
  EXPECT_EQ(end.code, 3);
  end = run("kill -SEGV $$");
  EXPECT_EQ(end.kind, ChildEnd::Kind::kSignalled);
  EXPECT_EQ(end.code, SIGSEGV);
  end = run("kill -KILL $$");  // the signal does not come from Grove
  EXPECT_EQ(end.kind, ChildEnd::Kind::kSignalled);
}

TEST_F(Children, AreTimed) {
  const ChildEnd end = run_for(42);
  EXPECT_EQ(end.kind, ChildEnd::Kind::kExited);
  EXPECT_GE(end.wall_s, 42);
  EXPECT_LT(end.wall_s, 60);
}

TEST_F(Children, AreKilledAtTheTimeLimit) {
  const auto look = [this] {
    now_ += 25;
    return false;
  };
  const ChildEnd end =
      run_child({"/bin/sh", "-c", kWithoutEnd}, directory_ / "said",
                {.seconds = 60, .cancelled = look, .clock = [this] { return now_; }});
  EXPECT_EQ(end.kind, ChildEnd::Kind::kTooLong);
  EXPECT_EQ(end.wall_s, 75);
}

TEST_F(Children, AreKilledOnRequest) {
  EXPECT_EQ(run(kWithoutEnd, true).kind, ChildEnd::Kind::kCancelled);
}

TEST_F(Children, WriteToAFileAndHaveNoInput) {
  run("echo out; echo err >&2; cat");
  EXPECT_EQ(file_content(directory_ / "said"), "out\nerr\n");
  run("true");
  EXPECT_EQ(file_content(directory_ / "said"), "");
}

TEST_F(Children, ReportThatTheyCannotBeStarted) {
  const ChildEnd end = run_child({directory_ / "missing"}, directory_ / "said",
                                 {.seconds = 60, .cancelled = [] { return false; }});
  EXPECT_EQ(end.kind, ChildEnd::Kind::kExited);
  EXPECT_EQ(end.code, 127);
  EXPECT_THROW(run_child({"/bin/true"}, directory_ / "no/folder",
                         {.seconds = 60, .cancelled = [] { return false; }}),
               std::system_error);
}

// Ctrl-C must send SIGINT only to the process group of the caller, so each child has its own group.
TEST_F(Children, HaveTheirOwnProcessGroup) {
  run("ps -o pgid= -p $$ | tr -d ' '; echo $$");
  const std::string said = file_content(directory_ / "said");
  const std::size_t line = said.find('\n');
  EXPECT_EQ(said.substr(0, line) + "\n", said.substr(line + 1));
}

TEST_F(Children, DieWithTheirParent) {
  const std::string fifo = directory_ / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const pid_t parent = ::fork();
  ASSERT_GE(parent, 0);
  if (parent == 0) {
    run("exec 3> '" + fifo + "'; echo $$ >&3; " + kWithoutEnd);
    ::_exit(0);
  }
  std::ifstream from_child(fifo);
  pid_t child = 0;
  from_child >> child;
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  EXPECT_GT(child, 0);
  // The child holds the write end while it runs, so end of file shows that it has ended.
  from_child >> child;
  EXPECT_TRUE(from_child.eof());
}

}  // namespace child_process_test
}  // namespace grove::detail::bench
