// SPDX-License-Identifier: MIT
// grove-fuzz-replan: random changes of a plan that is being driven. Every answer is checked, and
// measured beside solving the same from nothing in the same time.
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

struct Asked {
  std::string instance;
  std::string plan;
  int changes = 500;
  double time_limit_s = 0.2;
  std::uint64_t seed = 1;
  Time commit = 5;
  bool may_follow = true;
};

// When the first plan was there, and its cost.
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
  int without_plan = 0;        // and nothing has one
  int without_plan_alone = 0;  // but from nothing there was one
  int infeasible = 0;
  int impossible = 0;  // changes that cannot be
  std::vector<double> first_s, total_s, nothing_first_s;
  std::vector<double> first_to_end, end_to_nothing, gap;
};

double middle(std::vector<double> all, double at = 0.5) {
  if (all.empty()) return 0;
  std::ranges::sort(all);
  return all[static_cast<std::size_t>(at * static_cast<double>(all.size() - 1))];
}

class Campaign {
 public:
  Campaign(const Asked& asked, Instance instance, Plan plan)
      : asked_(asked), instance_(std::move(instance)), plan_(std::move(plan)) {}

  Results run() {
    for (std::uint64_t seed = asked_.seed; results_.answers < asked_.changes; ++seed) one(seed);
    return results_;
  }

 private:
  void one(std::uint64_t seed) {
    Random random(seed);
    Session session(instance_, plan_);
    const Time end = std::ranges::max(plan_.agents, {}, &AgentPlan::cost).cost;
    const Time time = random.below(end * 3 / 4 + 1);
    try {
      session.advance(time, testing::random_lateness(instance_, time, random));
      const Instance before = session.instance();
      const Plan old = *session.plan();
      session.change(testing::random_change(before, random));
      answer(session, old);
    } catch (const ImpossibleLateness&) {
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
    const Solution solution = session.solve(options(), limits, &first, asked_.commit);
    const double total = std::chrono::duration<double>(Clock::now() - start).count();
    FirstPlan nothing_first;
    Limits again;
    again.set_deadline(Clock::now() + to_duration());
    const Solution nothing = solve(session.instance(), options(), again, &nothing_first);
    ++results_.answers;
    if (solution.status == Status::kInfeasible || nothing.status == Status::kInfeasible) {
      ++results_.infeasible;
      if (solution.plan || nothing.plan) ++results_.wrong;
      return;
    }
    if (!solution.plan) {
      ++(nothing.plan ? results_.without_plan_alone : results_.without_plan);
      return;
    }
    if (!check(session.instance(), solution, 1).empty()) ++results_.wrong;
    if (solution.lower_bound > (nothing.plan ? nothing.plan->cost : solution.plan->cost))
      ++results_.wrong;
    if (!is_kept(old, *solution.plan)) ++results_.not_kept;
    results_.first_s.push_back(first.seconds);
    results_.total_s.push_back(total);
    results_.first_to_end.push_back(ratio(*first.cost, solution.plan->cost));
    results_.gap.push_back(ratio(solution.plan->cost, solution.lower_bound));
    if (!nothing.plan) return;
    results_.nothing_first_s.push_back(nothing_first.seconds);
    results_.end_to_nothing.push_back(ratio(solution.plan->cost, nothing.plan->cost));
  }

  static double ratio(Cost a, Cost b) {
    return b == 0 ? 1 : static_cast<double>(a) / static_cast<double>(b);
  }

  bool is_kept(const Plan& old, const Plan& now) const {
    for (std::size_t agent = 0; agent < old.agents.size(); ++agent)
      for (Time t = 0; t <= asked_.commit; ++t)
        if (state_at(old.agents[agent].path, t) != state_at(now.agents[agent].path, t))
          return false;
    return true;
  }

  Clock::duration to_duration() const {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(asked_.time_limit_s));
  }

  static SolveOptions options() {
    SolveOptions options;
    options.omega = Omega::parse("0.01");
    return options;
  }

  const Asked& asked_;
  const Instance instance_;
  const Plan plan_;
  Results results_;
};

void print(const Results& r) {
  const auto row = [](const char* name, const std::vector<double>& all, double factor) {
    fmt::print("{:<44}{:>10.3f}{:>10.3f}{:>10.3f}\n", name, factor * middle(all),
               factor * middle(all, 0.95), factor * middle(all, 1));
  };
  fmt::print("{} answers ({} changes could not be): {} wrong, {} do not keep what is committed\n",
             r.answers, r.impossible, r.wrong, r.not_kept);
  fmt::print("without a plan: {} where there is none, {}; {} where from nothing there was one\n",
             r.infeasible, r.without_plan, r.without_plan_alone);
  fmt::print("{:<44}{:>10}{:>10}{:>10}\n", "", "median", "95 %", "worst");
  row("first plan after, ms", r.first_s, 1000);
  row("from nothing: first plan after, ms", r.nothing_first_s, 1000);
  row("all of it, ms", r.total_s, 1000);
  row("cost of the first plan / of the last", r.first_to_end, 1);
  row("cost of the last plan / from nothing", r.end_to_nothing, 1);
  row("cost of the last plan / lower bound", r.gap, 1);
}

int main(int argc, char** argv) {
  CLI::App app("Random changes of a plan that is being driven", "grove-fuzz-replan");
  Asked asked;
  app.add_option("INSTANCE", asked.instance)->required();
  app.add_option("PLAN", asked.plan)->required();
  app.add_option("--changes", asked.changes, "so many answers")->capture_default_str();
  app.add_option("--time-limit", asked.time_limit_s, "of each, in s")->capture_default_str();
  app.add_option("--commit", asked.commit, "steps")->capture_default_str();
  app.add_flag("!--no-following", asked.may_follow, "of a plan in which none follows another");
  app.add_option("--seed", asked.seed, "of the first one")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  Instance instance = read_instance(asked.instance).instance;
  if (!asked.may_follow) instance = instance.without_following();
  const Solution solution = read_solution(asked.plan, instance);
  const Results results = Campaign(asked, std::move(instance), *solution.plan).run();
  print(results);
  return results.wrong + results.not_kept > 0 ? 1 : 0;
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  return grove::detail::main(argc, argv);
}
