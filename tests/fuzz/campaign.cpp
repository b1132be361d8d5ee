// SPDX-License-Identifier: MIT
#include "tests/fuzz/campaign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "tests/fuzz/random.h"
#include "tests/fuzz/shrink.h"

namespace grove::detail::fuzz {
namespace {

constexpr std::chrono::seconds kShrinkingTime{60};

std::string problem_of(const TinyInstance& instance) {
  const auto mg = std::ranges::count_if(instance.agents, [](const auto& a) { return !a.goal; });
  if (mg == 0) return instance.tasks.empty() ? "MAPF" : "CTS";
  return mg == std::ssize(instance.agents) ? "MG" : "mixed";
}

// Returns the kind of world: "grid" or "roads", then " + turning" if turns take time, and " + work"
// if tasks have a duration.
std::string world_of(const TinyInstance& instance) {
  std::string world = instance.roads.empty() ? "grid" : "roads";
  const auto agent_with = [&](auto what) { return std::ranges::any_of(instance.agents, what); };
  if (agent_with([](const auto& a) { return a.turn_steps > 0; })) world += " + turning";
  if (std::ranges::any_of(instance.tasks, [](const auto& t) { return t.duration > 0; }))
    world += " + work";
  return world;
}

std::vector<std::string> traits_of(const TinyInstance& instance) {
  std::vector<std::string> traits;
  const auto note = [&](bool holds, const char* trait) {
    if (holds) traits.emplace_back(trait);
  };
  const auto agent_with = [&](auto what) { return std::ranges::any_of(instance.agents, what); };
  const Instance built = instance.build();
  note(std::ranges::any_of(built.agents(), &Agent::is_idle), "idle agents");
  note(agent_with([](const auto& a) { return a.goal_heading.has_value(); }), "goal headings");
  note(agent_with([](const auto& a) { return a.turned > 0; }), "starts within turns");
  note(agent_with([](const auto& a) { return a.work >= 0; }), "starts at work");
  note(agent_with([](const auto& a) { return a.road >= 0; }), "starts on roads");
  std::vector<Position> cells;
  bool shared = false;
  for (const auto& task : instance.tasks) {
    shared = shared || std::ranges::count(cells, task.cell) > 0;
    cells.push_back(task.cell);
  }
  note(shared, "several tasks on a cell");
  return traits;
}

std::string counts(const std::map<std::string, std::int64_t>& of) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : of) parts.push_back(fmt::format("{} {}", name, count));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Limits::Clock::time_point after(double seconds) {
  return Limits::Clock::now() + std::chrono::duration_cast<Limits::Clock::duration>(
                                    std::chrono::duration<double>(seconds));
}

}  // namespace

void Tally::add(const FuzzCase& fuzz_case, const CaseResult& result) {
  if (result.too_large) {
    ++too_large;
    return;
  }
  ++(result.complaints.empty() ? passed : failed);
  infeasible += !result.solvable;
  if (result.solvable && fuzz_case.limit == ImposedLimit::kNothing) {
    ++unstopped;
    unsolved += result.stopped;
  }
  ++by_status[std::string(to_string(result.status))];
  ++by_omega[fuzz_case.options.omega.to_string()];
  ++by_kind[problem_of(fuzz_case.instance)];
  ++by_world[world_of(fuzz_case.instance)];
  for (const std::string& trait : traits_of(fuzz_case.instance)) ++by_trait[trait];
}

double Tally::unsolved_percent() const {
  return unstopped == 0 ? 0 : 100 * static_cast<double>(unsolved) / static_cast<double>(unstopped);
}

std::string Tally::summary() const {
  return fmt::format(
      "kinds:  {}\nworlds: {}\nwith:   {}\nomega:  {}\nstatus: {}\nwithout a plan {}, not solved "
      "in time {} of {}, "
      "too large for the oracle {}\n{} passed, {} failed\n",
      counts(by_kind), counts(by_world), counts(by_trait), counts(by_omega), counts(by_status),
      infeasible, unsolved, unstopped, too_large, passed, failed);
}

std::string Failure::report() const {
  return fmt::format(
      "The solver is wrong:\n  {}\nin this case (to commit it, add a comment line at the "
      "top):\n\n{}\n"
      "shrunk from:\n\n{}",
      fmt::join(result.complaints, "\n  "), shrunk.to_text(), original.to_text());
}

Failure explain(const FuzzCase& fuzz_case, CaseResult first, const Solver& solver,
                std::chrono::milliseconds patience) {
  Limits limits;
  limits.set_deadline(Limits::Clock::now() + kShrinkingTime);
  const auto fails = [&](const FuzzCase& c) {
    return !run_case(c, solver, patience).complaints.empty();
  };
  Failure failure{fuzz_case, shrink(fuzz_case, fails, limits), {}};
  failure.result = run_case(failure.shrunk, solver, patience);
  if (failure.result.complaints.empty()) {  // runs with several threads are not always repeatable
    failure.result = std::move(first);
    failure.result.complaints.push_back("(in the first run only; a repetition did not fail)");
  }
  return failure;
}

std::optional<Failure> run_campaign(const Campaign& campaign, const Solver& solver, Tally& tally) {
  Limits limits;
  if (campaign.seconds) limits.set_deadline(after(*campaign.seconds));
  for (std::int64_t k = 0; k < campaign.count && !limits.stop_requested(); ++k) {
    const std::uint64_t seed = campaign.seed + static_cast<std::uint64_t>(k);
    FuzzCase fuzz_case = random_case(seed);
    if (Random(seed ^ 0xC401CE).percent(campaign.choices_percent))
      fuzz_case = with_choices(std::move(fuzz_case), seed + 1);
    if (!campaign.trace.empty()) std::ofstream(campaign.trace) << fuzz_case.to_text();
    const CaseResult result = run_case(fuzz_case, solver, campaign.patience);
    tally.add(fuzz_case, result);
    if (!result.complaints.empty()) return explain(fuzz_case, result, solver, campaign.patience);
  }
  return std::nullopt;
}

}  // namespace grove::detail::fuzz
