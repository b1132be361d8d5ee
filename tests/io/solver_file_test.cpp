// SPDX-License-Identifier: MIT
#include "io/solver_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/refusal.h"

namespace grove::detail {
namespace solver_file_test {

using Words = std::vector<std::string>;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

const std::string kFull =
    R"solver({"name": "mine", "about": "a solver", "anytime": true, "threads": 3,
"command": "{program} '-x y' {map} {scenario} -k={agents}", "plan": "{folder}/paths",
"claims": {"solved": "done", "cost": "cost (\\d+)",
           "first_plan": {"file": "{folder}/log", "regex": "in (\\d+)", "unit": "ms"}},
"trace": [{"regex": "(\\d+) at (\\d+) over (\\d+)",
           "groups": ["cost", "seconds_left", "lower_bound"]}]})solver";

std::string refused(const std::string& text) {
  return refusal([&] { parse_solver(text, "s.json"); });
}
std::string refused_with(const std::string& what, const std::string& by) {
  return refused(replaced(kFull, what, by));
}

TEST(SolverFiles, HoldAllSettings) {
  const SolverAdapter solver = parse_solver(kFull, "s.json");
  EXPECT_EQ(solver.name, "mine");
  EXPECT_EQ(solver.command, (Words{"{program}", "-x y", "{map}", "{scenario}", "-k={agents}"}));
  EXPECT_EQ(solver.input, SolverInput::kMovingAi);
  EXPECT_EQ(solver.plan, "{folder}/paths");
  EXPECT_TRUE(solver.anytime);
  EXPECT_EQ(solver.threads, 3);
  EXPECT_EQ(solver.solved->regex, "done");
  EXPECT_EQ(solver.cost->file, "");
  EXPECT_EQ(solver.first_plan->file, "{folder}/log");
  EXPECT_EQ(solver.first_plan->scale, 1e-3);
  EXPECT_FALSE(solver.seconds || solver.lower_bound);
  ASSERT_EQ(solver.trace.size(), 1u);
  EXPECT_EQ(solver.trace[0].groups,
            (std::vector<TraceGroup>{TraceGroup::kCost, TraceGroup::kSecondsLeft,
                                     TraceGroup::kLowerBound}));
}

TEST(SolverFiles, HaveDefaults) {
  const SolverAdapter solver = parse_solver(
      R"({"name": "s", "command": "{program} {instance}", "instance": "mgcbs"})", "s.json");
  EXPECT_EQ(solver.input, SolverInput::kMgcbs);
  EXPECT_EQ(solver.plan, "{output}");
  EXPECT_FALSE(solver.anytime);
  EXPECT_EQ(solver.threads, 1);
  const SolverAdapter silent = parse_solver(
      R"solver({"name": "s", "command": "{program} {instance}", "instance": "grove",
                "plan": null, "claims": {"cost": "(\\d)"}})solver",
      "s.json");
  EXPECT_EQ(silent.plan, "");
}

TEST(SolverFiles, AreRefusedWithThePlaceIfInvalid) {
  EXPECT_EQ(refused("[]"), "s.json: /: found an array; expected a JSON object");
  EXPECT_EQ(refused_with("\"threads\"", "\"thread\""),
            "s.json: /: unknown key 'thread'; expected 'threads', if that is meant");
  EXPECT_EQ(refused_with("\"cost\": ", "\"price\": "),
            "s.json: /claims: unknown key 'price'; expected one of solved, cost, lower_bound, "
            "seconds, first_plan, or a name that begins with '_', for a remark");
  EXPECT_EQ(refused_with("{agents}", "{agent}"),
            "s.json: /command: found {agent}; expected one of {program}, {map}, {scenario}, "
            "{agents}, {instance}, {time_limit}, {time_limit_ms}, {time_limit_whole}, {seed}, "
            "{output}, {folder}");
  EXPECT_EQ(refused_with("{program} ", ""), "s.json: /command: expected {program} as the program");
  EXPECT_EQ(refused_with("{scenario} ", ""), "s.json: /command: expected {map} and {scenario}");
  EXPECT_EQ(refused_with("{map}", "{map} {instance}"),
            "s.json: /command: expected {instance}, or {map} and {scenario}, and not both");
  EXPECT_EQ(refused_with("'-x y'", "'-x y"), "s.json: /command: a quote is not closed");
  EXPECT_EQ(refused_with("\"mine\"", "\"my solver\""),
            "s.json: /name: found \"my solver\"; expected a name of letters, digits and -_.+= "
            "without blanks");
  EXPECT_EQ(refused_with("cost (\\\\d+)", "cost \\\\d+"),
            "s.json: /claims/cost: found 0 groups in round brackets; expected 1");
  EXPECT_NE(
      refused_with("cost (\\\\d+)", "cost (\\\\d+")
          .find("s.json: /claims/cost: found 'cost (\\d+', which is not a regular expression"),
      std::string::npos);
  EXPECT_EQ(refused_with("\"unit\": \"ms\"", "\"unit\": \"h\""),
            "s.json: /claims/first_plan/unit: found \"h\"; expected s or ms");
  EXPECT_EQ(
      refused_with("\"cost\", \"seconds_left\"", "\"cost\", \"cost\""),
      "s.json: /trace/0/groups: expected cost once and exactly one time: seconds, milliseconds "
      "or seconds_left");
  EXPECT_EQ(refused_with("(\\\\d+) at (\\\\d+) over", "(\\\\d+) at over"),
            "s.json: /trace/0/regex: found 2 groups in round brackets; expected 3");
  EXPECT_EQ(refused(R"({"name": "s", "command": "{program} {map} {scenario}", "plan": null})"),
            "s.json: /: found neither a plan nor claims; expected one of plan, claims");
}

// The solver files that Grove provides are read with the same strict rules.
TEST(SolverFiles, OfGroveAreValid) {
  int count = 0;
  for (const auto& item : std::filesystem::directory_iterator(GROVE_SOLVERS)) {
    const SolverAdapter solver = read_solver(item.path());
    EXPECT_EQ(solver.name, item.path().stem());
    ++count;
  }
  EXPECT_EQ(count, 7);
}

TEST(SolverCommands, AreSplitIntoWords) {
  EXPECT_EQ(command_words(" a  'b c'\td\"e \"'f' \n"), (Words{"a", "b c", "de f"}));
  EXPECT_EQ(command_words("a ''"), (Words{"a", ""}));
  EXPECT_EQ(command_words(""), Words());
  EXPECT_EQ(command_words("a 'b"), std::nullopt);
  EXPECT_EQ(command_words("a \"b'"), std::nullopt);
}

TEST(SolverTemplates, AreFilledWithValues) {
  const auto value = [](std::string_view name) { return "<" + std::string(name) + ">"; };
  EXPECT_EQ(filled("a{map}b{seed}{map}", value), "a<map>b<seed><map>");
  EXPECT_EQ(filled("plain", value), "plain");
  EXPECT_EQ(template_mistake("a{map}b{seed}"), "");
  for (const char* text : {"a{map", "map}", "{map}}", "{"})
    EXPECT_EQ(template_mistake(text),
              "found an unpaired brace; expected names in braces, such as {map}")
        << text;
  EXPECT_TRUE(template_mistake("{}").starts_with("found {}; expected one of {program}"));
  EXPECT_TRUE(template_mistake("{{map}}").starts_with("found {{map}; expected one of"));
  EXPECT_TRUE(names({"a", "-k={map}"}, "map"));
  EXPECT_FALSE(names({"map", "{maps}"}, "map"));
}

}  // namespace solver_file_test
}  // namespace grove::detail
