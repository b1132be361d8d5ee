// SPDX-License-Identifier: MIT
#include "tools/bench/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/support/temporary_directory.h"

namespace grove::detail::bench {
namespace child_process_test {

class Children : public ::testing::Test {
 protected:
  ChildEnd run(const std::string& script, double seconds = 60, bool cancelled = false) {
    return run_child({"/bin/sh", "-c", script}, directory_ / "said",
                     {.seconds = seconds, .cancelled = [cancelled] { return cancelled; }});
  }

  TemporaryDirectory directory_;
};

TEST_F(Children, EndByThemselves) {
  ChildEnd end = run("exit 3");
  EXPECT_EQ(end.kind, ChildEnd::Kind::kExited);
  EXPECT_EQ(end.code, 3);
  end = run("kill -SEGV $$");
  EXPECT_EQ(end.kind, ChildEnd::Kind::kSignalled);
  EXPECT_EQ(end.code, SIGSEGV);
  end = run("kill -KILL $$");  // not by us
  EXPECT_EQ(end.kind, ChildEnd::Kind::kSignalled);
  EXPECT_EQ(run("sleep 0.2").kind, ChildEnd::Kind::kExited);
}

TEST_F(Children, AreTimed) {
  const ChildEnd end = run("sleep 0.2");
  EXPECT_GE(end.wall_s, 0.2);
  EXPECT_LT(end.wall_s, 30);
}

TEST_F(Children, AreKilledWhenTheyLastTooLong) {
  const ChildEnd end = run("sleep 60", 0.1);
  EXPECT_EQ(end.kind, ChildEnd::Kind::kTooLong);
  EXPECT_GE(end.wall_s, 0.1);
  EXPECT_LT(end.wall_s, 30);
}

TEST_F(Children, AreKilledOnRequest) {
  EXPECT_EQ(run("sleep 60", 60, true).kind, ChildEnd::Kind::kCancelled);
}

TEST_F(Children, SpeakIntoAFileAndHearNothing) {
  run("echo out; echo err >&2; cat");
  EXPECT_EQ(file_content(directory_ / "said"), "out\nerr\n");
  run("true");
  EXPECT_EQ(file_content(directory_ / "said"), "");
}

TEST_F(Children, ThatCannotBeStartedSaySo) {
  const ChildEnd end = run_child({directory_ / "missing"}, directory_ / "said",
                                 {.seconds = 60, .cancelled = [] { return false; }});
  EXPECT_EQ(end.kind, ChildEnd::Kind::kExited);
  EXPECT_EQ(end.code, 127);
  EXPECT_THROW(run_child({"/bin/true"}, directory_ / "no/folder",
                         {.seconds = 60, .cancelled = [] { return false; }}),
               std::system_error);
}

// Ctrl-C reaches the group of the caller.
TEST_F(Children, AreInAGroupOfTheirOwn) {
  run("ps -o pgid= -p $$ | tr -d ' '; echo $$");
  const std::string said = file_content(directory_ / "said");
  const std::size_t line = said.find('\n');
  EXPECT_EQ(said.substr(0, line) + "\n", said.substr(line + 1));
}

TEST_F(Children, DieWithTheirParent) {
  const pid_t parent = ::fork();
  ASSERT_GE(parent, 0);
  if (parent == 0) {
    run("echo $$; exec sleep 60");
    ::_exit(0);
  }
  pid_t child = 0;
  for (int i = 0; i < 1000 && child == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::ifstream(directory_ / "said") >> child;
  }
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  ASSERT_GT(child, 0);
  // Someone else reaps it: it may be a zombie for a while.
  const auto lives = [child] {
    std::string state;
    std::ifstream file("/proc/" + std::to_string(child) + "/stat");
    file >> state >> state >> state;
    return file.good() && state != "Z" && state != "X";
  };
  for (int i = 0; i < 1000 && lives(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(lives());
}

}  // namespace child_process_test
}  // namespace grove::detail::bench
