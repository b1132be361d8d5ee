// SPDX-License-Identifier: MIT
// grove-fuzz-replan: applies random changes to a plan during its execution, checks every answer,
// and compares it with a solve from scratch under the same time limit.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "engine/run_observer.h"
#include "engine/session.h"
#include "io/instance_file.h"
#include "io/plan_file.h"
#include "model/check.h"
#include "tests/engine/random_change.h"

namespace grove::detail {
namespace {

using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string instance;
  std::string plan;
  int changes = 500;
  double time_limit_s = 0.2;
  std::uint64_t seed = 1;
  Time commit = 5;
  bool may_follow = true;
};

// Records the cost of the first plan and the time until it was found.
class FirstPlan : public RunObserver {
 public:
  void on_incumbent(const Plan& plan, PlanSource, const Progress&) override {
    if (cost) return;
    cost = plan.cost;
    seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  }
  std::optional<Cost> cost;
  double seconds = 0;

 private:
  const Clock::time_point start_ = Clock::now();
};

struct Results {
  int answers = 0;
  int wrong = 0;
  int not_kept = 0;
  // Changes for which neither re-planning nor the solve from scratch found a plan.
  int without_plan = 0;
  // Changes for which only the solve from scratch found a plan.
  int without_plan_unlike_scratch = 0;
  int infeasible = 0;
  int impossible = 0;  // changes and delays refused as impossible
  std::vector<double> first_s, total_s, scratch_first_s;
  std::vector<double> first_to_end, end_to_scratch, gap;
};

double quantile(std::vector<double> all, double at = 0.5) {
  if (all.empty()) return 0;
  std::ranges::sort(all);
  return all[static_cast<std::size_t>(at * static_cast<double>(all.size() - 1))];
}

class Campaign {
 public:
  Campaign(const Arguments& arguments, Instance instance, Plan plan)
      : arguments_(arguments), instance_(std::move(instance)), plan_(std::move(plan)) {}

  Results run() {
    for (std::uint64_t seed = arguments_.seed; results_.answers < arguments_.changes; ++seed)
      run_one(seed);
    return results_;
  }

 private:
  void run_one(std::uint64_t seed) {
    Random random(seed);
    Session session(instance_, plan_);
    const Time end = std::ranges::max(plan_.agents, {}, &AgentPlan::cost).cost;
    const Time time = random.below(end * 3 / 4 + 1);
    try {
      session.advance(time, testing::random_delays(instance_, time, random));
      const Instance before = session.instance();
      const Plan old = *session.plan();
      session.change(testing::random_change(before, random));
      answer(session, old);
    } catch (const InfeasibleDelay&) {
      ++results_.impossible;
    } catch (const InstanceError&) {
      ++results_.impossible;
    } catch (const Session::NotCommitted&) {
      ++results_.impossible;
    }
  }

  void answer(Session& session, const Plan& old) {
    FirstPlan first;
    const auto start = Clock::now();
    Limits limits;
    limits.set_deadline(start + to_duration());
    const Solution solution = session.solve(options(), limits, &first, arguments_.commit);
    const double total = std::chrono::duration<double>(Clock::now() - start).count();
    FirstPlan scratch_first;
    Limits scratch_limits;
    scratch_limits.set_deadline(Clock::now() + to_duration());
    const Solution scratch = solve(session.instance(), options(), scratch_limits, &scratch_first);
    ++results_.answers;
    if (solution.status == Status::kInfeasible || scratch.status == Status::kInfeasible) {
      ++results_.infeasible;
      if (solution.plan || scratch.plan) ++results_.wrong;
      return;
    }
    if (!solution.plan) {
      ++(scratch.plan ? results_.without_plan_unlike_scratch : results_.without_plan);
      return;
    }
    if (!check(session.instance(), solution, 1).empty()) ++results_.wrong;
    if (solution.lower_bound > (scratch.plan ? scratch.plan->cost : solution.plan->cost))
      ++results_.wrong;
    if (!is_kept(old, *solution.plan)) ++results_.not_kept;
    results_.first_s.push_back(first.seconds);
    results_.total_s.push_back(total);
    results_.first_to_end.push_back(ratio(*first.cost, solution.plan->cost));
    results_.gap.push_back(ratio(solution.plan->cost, solution.lower_bound));
    if (!scratch.plan) return;
    results_.scratch_first_s.push_back(scratch_first.seconds);
    results_.end_to_scratch.push_back(ratio(solution.plan->cost, scratch.plan->cost));
  }

  static double ratio(Cost a, Cost b) {
    return b == 0 ? 1 : static_cast<double>(a) / static_cast<double>(b);
  }

  bool is_kept(const Plan& old, const Plan& now) const {
    for (std::size_t agent = 0; agent < old.agents.size(); ++agent)
      for (Time t = 0; t <= arguments_.commit; ++t)
        if (state_at(old.agents[agent].path, t) != state_at(now.agents[agent].path, t))
          return false;
    return true;
  }

  Clock::duration to_duration() const {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(arguments_.time_limit_s));
  }

  static SolveOptions options() {
    SolveOptions options;
    options.omega = Omega::parse("0.01");
    return options;
  }

  const Arguments& arguments_;
  const Instance instance_;
  const Plan plan_;
  Results results_;
};

void print(const Results& r) {
  const auto row = [](const char* name, const std::vector<double>& all, double factor) {
    fmt::print("{:<44}{:>10.3f}{:>10.3f}{:>10.3f}\n", name, factor * quantile(all),
               factor * quantile(all, 0.95), factor * quantile(all, 1));
  };
  fmt::print("{} answers ({} changes impossible): {} wrong, {} violate the committed steps\n",
             r.answers, r.impossible, r.wrong, r.not_kept);
  fmt::print("without a plan: {} infeasible, {} not found by either; {} found only from scratch\n",
             r.infeasible, r.without_plan, r.without_plan_unlike_scratch);
  fmt::print("{:<44}{:>10}{:>10}{:>10}\n", "", "median", "95 %", "worst");
  row("first plan after, ms", r.first_s, 1000);
  row("from scratch: first plan after, ms", r.scratch_first_s, 1000);
  row("total, ms", r.total_s, 1000);
  row("cost of the first plan / of the last", r.first_to_end, 1);
  row("cost of the last plan / from scratch", r.end_to_scratch, 1);
  row("cost of the last plan / lower bound", r.gap, 1);
}

int main(int argc, char** argv) {
  CLI::App app("Random changes of a plan during its execution", "grove-fuzz-replan");
  Arguments arguments;
  app.add_option("INSTANCE", arguments.instance)->required();
  app.add_option("PLAN", arguments.plan)->required();
  app.add_option("--changes", arguments.changes, "number of answers")->capture_default_str();
  app.add_option("--time-limit", arguments.time_limit_s, "time limit of each answer, in s")
      ->capture_default_str();
  app.add_option("--commit", arguments.commit, "committed steps")->capture_default_str();
  app.add_flag("!--no-following", arguments.may_follow, "for a plan without following");
  app.add_option("--seed", arguments.seed, "seed of the first change")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  Instance instance = read_instance(arguments.instance).instance;
  if (!arguments.may_follow) instance = instance.without_following();
  const Solution solution = read_solution(arguments.plan, instance);
  const Results results = Campaign(arguments, std::move(instance), *solution.plan).run();
  print(results);
  return results.wrong + results.not_kept > 0 ? 1 : 0;
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  return grove::detail::main(argc, argv);
}
