// SPDX-License-Identifier: MIT
// Tests help, version, and the exit code and message for wrong usage.
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace usage_test {

using Arguments = std::vector<std::string>;

TEST(Usage, HelpHasUsageExitCodesAndExamples) {
  for (const Arguments& arguments : {Arguments{"--help"},
                                     {"-h"},
                                     {"check", "--help"},
                                     {"convert", "--help"},
                                     {"view", "--help"},
                                     {"proof", "--help"},
                                     {"proof", "trim", "--help"},
                                     {"generate", "--help"},
                                     {"generate", "map", "--help"},
                                     {"generate", "map", "rooms", "--help"},
                                     {"generate", "roadmap", "--help"},
                                     {"generate", "scenario", "--help"},
                                     {"generate", "instance", "--help"},
                                     {"generate", "dataset", "--help"},
                                     {"generate", "paper", "--help"},
                                     {"bench", "--help"},
                                     {"help"},
                                     {"help", "solve"},
                                     {"help", "generate", "map"}}) {
    const ProcessResult result = run_grove(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments[0];
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find("Usage: grove"), std::string::npos);
    EXPECT_GT(std::ranges::count(result.out, '\n'), 10) << result.out;
  }
  EXPECT_NE(run_grove({"--help"}).out.find("Exit codes:"), std::string::npos);
  EXPECT_NE(run_grove({"check", "--help"}).out.find("Examples:"), std::string::npos);
  EXPECT_EQ(run_grove({"help", "generate", "map", "rooms"}).out,
            run_grove({"generate", "map", "rooms", "--help"}).out);
}

TEST(Usage, VersionNamesTheCommit) {
  const ProcessResult result = run_grove({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.out.starts_with("grove 0.1.0 (git ")) << result.out;
}

TEST(Usage, WrongUsagePrintsOneLineAndAHint) {
  const auto said = [](const Arguments& arguments) { return complaint(run_grove(arguments)); };
  EXPECT_EQ(said({}), "a command is required (see 'grove --help')");
  EXPECT_EQ(said({"frob"}), "unknown command 'frob' (see 'grove --help')");
  EXPECT_EQ(said({"generate", "frob"}),
            "unknown command 'frob'; expected one of map, roadmap, scenario, instance, dataset, "
            "paper (see 'grove generate --help')");
  EXPECT_EQ(said({"generate", "map", "maze", "-o", "m.map"}),
            "unknown command 'maze'; expected one of empty, random, rooms (see 'grove generate map "
            "--help')");
  EXPECT_EQ(said({"generate", "map"}),
            "a command is required; expected one of empty, random, rooms (see 'grove generate map "
            "--help')");
  EXPECT_EQ(said({"check"}), "INSTANCE is required (see 'grove check --help')");
  EXPECT_EQ(said({"check", "a"}), "PLAN is required (see 'grove check --help')");
  EXPECT_EQ(said({"check", "a", "b", "--bogus"}),
            "unknown option '--bogus' (see 'grove check --help')");
  EXPECT_EQ(said({"solve", "a", "--omga", "0"}),
            "unknown option '--omga'; did you mean '--omega'? (see 'grove solve --help')");
  EXPECT_EQ(said({"solv", "a"}),
            "unknown command 'solv'; did you mean 'solve'? (see 'grove --help')");
  EXPECT_EQ(said({"help", "chekc"}),
            "unknown command 'chekc'; did you mean 'check'? (see 'grove --help')");
  EXPECT_EQ(said({"check", "a", "b", "c"}), "unexpected argument 'c' (see 'grove check --help')");
  EXPECT_EQ(said({"check", "a.scen", "b", "--agents", "2"}),
            "a.scen: cannot be read: No such file or directory");
  EXPECT_EQ(said({"check", "a.scen", "b", "--map", "m"}),
            "--agents: required with a .scen file (see 'grove check --help')");
  EXPECT_EQ(said({"check", "a.json", "b", "--map", "m"}),
            "--map, --agents: allowed only with a .scen file (see 'grove check --help')");
  EXPECT_EQ(said({"generate", "map", "empty"}),
            "--output is required (see 'grove generate map empty --help')");
  EXPECT_EQ(said({"generate", "map", "empty", "-o", "x", "a\nb"}),
            "unexpected argument 'a\\nb' (see 'grove generate map empty --help')");
}

TEST(Usage, OptionsBeforeTheCommandAreRefused) {
  const auto said = [](const Arguments& arguments) { return complaint(run_grove(arguments)); };
  EXPECT_EQ(said({"my.cts.json", "solve"}),
            "found 'my.cts.json' before the command; expected 'grove solve ...', options and files "
            "after it (see 'grove --help')");
  EXPECT_EQ(said({"--threads", "2", "solve", "my.cts.json"}),
            "found '--threads' before the command; expected 'grove solve ...', options and files "
            "after it (see 'grove --help')");
  EXPECT_EQ(said({"generate", "--width", "3", "map"}),
            "found '--width' before the command; expected 'grove generate map ...', options and "
            "files after it (see 'grove --help')");
  EXPECT_EQ(said({"help", "solve", "frob"}), "unknown command 'frob' (see 'grove --help')");
}

// As with compilers, callers can override options that a script sets.
TEST(Usage, LastOfARepeatedOptionCounts) {
  const TemporaryDirectory directory;
  const std::string map = directory / "m.map";
  EXPECT_EQ(run_grove({"generate", "map", "empty", "-o", "/nowhere/m.map", "--width", "9",
                       "--output", map, "--width", "3", "--height", "2"})
                .exit_code,
            0);
  EXPECT_EQ(file_content(map), "type octile\nheight 2\nwidth 3\nmap\n...\n...\n");
}

TEST(Usage, InvalidNumberMessageNamesTheRange) {
  const auto said = [](const std::string& option, const std::string& value) {
    return complaint(run_grove({"generate", "map", "random", "-o", "/dev/null", option, value}));
  };
  const std::string hint = " (see 'grove generate map random --help')";
  for (const char* wrong :
       {"x", "", "1.5", "0", "-3", "8193", "99999999999999999999", "0x10", "1e3", " 4"})
    EXPECT_EQ(said("--width", wrong), "--width: found '" + std::string(wrong) +
                                          "'; expected an integer from 1 to 8192" + hint);
  for (const char* wrong : {"x", "-0.1", "1.1", "nan", "inf", "1e999", "0,5"})
    EXPECT_EQ(said("--obstacles", wrong), "--obstacles: found '" + std::string(wrong) +
                                              "'; expected a number from 0 to 1" + hint);
  EXPECT_EQ(said("--seed", "-1"), "--seed: found '-1'; expected an integer of at least 0" + hint);
  EXPECT_EQ(
      said("--obstacles", "1"),
      "map: 1024 obstacles on 1024 cells leave fewer than 2 passable cells; expected at least 2" +
          hint);
}

TEST(Usage, UnwritableStandardOutputIsAnError) {
  const ProcessResult result =
      run_program({"/bin/sh", "-c", "exec \"$0\" --help >/dev/full", GROVE_PROGRAM});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "grove: error: standard output: cannot be written\n");
}

TEST(Usage, FullDiskLeavesNoFile) {
  const TemporaryDirectory directory;
  ProcessOptions options;
  options.largest_file = 500;
  EXPECT_EQ(complaint(run_grove({"generate", "map", "empty", "-o", directory / "m.map"}, options)),
            (directory / "m.map") + ": cannot be written: File too large");
  EXPECT_TRUE(directory.files().empty());
}

}  // namespace usage_test
}  // namespace grove::detail
