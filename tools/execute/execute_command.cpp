// SPDX-License-Identifier: MIT
// grove execute: simulates executions of a plan with disturbances.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "execution/switching.h"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/passing_order_file.h"
#include "io/plan_file.h"
#include "io/plan_import.h"
#include "model/check.h"
#include "model/choices.h"
#include "tools/common/commands.h"
#include "tools/common/frame_arguments.h"
#include "tools/common/instance_arguments.h"
#include "tools/common/options.h"
#include "tools/common/own_files.h"
#include "tools/execute/disturbances.h"
#include "tools/execute/robots.h"
#include "tools/solve/solve_arguments.h"
#include "tools/view/page.h"
#include "tools/view/page_data.h"

namespace grove::detail {
namespace {

constexpr IntegerRange kRuns{1, 1'000'000};
constexpr IntegerRange kDelaySteps{1, 1'000'000};
constexpr std::size_t kMaxStuckShown = 20;

constexpr const char* kExecuteFooter =
    R"(Robots execute the plan along its passing order, not by the clock: each action starts as soon as the
robot that uses the place before it has left. So robots never collide and never deadlock, whatever
the delays. A robot that moves occupies both places until it has arrived, and a robot that follows
it waits for that. So even without disturbances an execution may take longer than the plan.

With --switch a robot that has waited for another one for some steps goes first where they meet
next, if that reduces the expected sum of finish times. The order stays free of cycles. The table
then has both executions, with the same delays.

Every execution is checked like a plan, from its paths. If robots fail (--fail), the others continue
as far as they can, and the output lists which robot waits for which. With --runs, each execution
has different random delays; the table has the median and the worst value of each column, over the executions
that end.

--stop and --fail are independent of other delays; several stops of a robot add up. In the plan that
--output writes, a robot whose action took longer waits before that action.

Examples:
  grove execute my.cts.json my.plan.json --delays 0.1 --runs 1000
  grove execute my.cts.json my.plan.json --slow r3=1.5 --stop r5@20=60 --view driven.html
  grove execute my.cts.json my.plan.json --delays 0.1 --stop r5@20=60 --runs 100 --switch
  grove execute my.cts.json my.plan.json --fail r3@12
  grove execute my.cts.json my.plan.json --order order.json)";

struct ExecuteArguments {
  InstanceArguments instance;
  std::string plan;
  DisturbanceArguments troubles;
  bool switches = false;
  std::int64_t runs = 1;
  std::int64_t seed = 0;
  std::string order;
  FrameArguments frame;
  std::string output;
  std::string view;
};

// Results of several simulated executions.
struct Totals {
  std::vector<Cost> makespans;
  std::vector<Cost> costs;

  void add(const ActionDependencyGraph& order, const ExecutionTrace& trace) {
    Cost makespan = 0;
    Cost cost = 0;
    for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
      const Cost finish = trace.finish(order, agent);
      makespan = std::max(makespan, finish);
      cost += finish;
    }
    makespans.push_back(makespan);
    costs.push_back(cost);
  }
};

class Execution {
 public:
  Execution(const CLI::App& app, const ExecuteArguments& arguments)
      : a_(arguments),
        options_(options_text(app)),
        loaded_(load(arguments.instance)),
        claimed_(read_plan_to_execute(arguments.plan, loaded_.instance)),
        order_(loaded_.instance, *claimed_.solution.plan) {}

  void run() {
    require_distinct_outputs({{"--order", a_.order}, {"--output", a_.output}, {"--view", a_.view}},
                             a_.instance, loaded_, {a_.plan});
    if (!a_.order.empty())
      write(a_.order,
            passing_order_text(loaded_.instance, order_, a_.frame.frame(loaded_.instance)));
    const Disturbances troubles(a_.troubles, loaded_.instance);
    for (std::int64_t run = 0; run < a_.runs; ++run) simulate_once(troubles, a_.seed + run);
    print();
    if (a_.switches) fmt::print("switched: {} places\n", switches_);
    if (unfinished_ > 0) report_blocked_robots();
  }

 private:
  static LoadedInstance load(const InstanceArguments& arguments) {
    LoadedInstance loaded = arguments.load();
    arguments.require_no_choices(loaded.instance, "passing orders do not support", kFixedChoices);
    return loaded;
  }

  static void write(const std::string& file, const std::string& text) {
    write_file_atomically(file, text);
    fmt::print("wrote {}\n", file);
  }

  void simulate_once(const Disturbances& troubles, std::int64_t seed) {
    const auto durations = [&] {
      return troubles.durations(order_, static_cast<std::uint64_t>(seed));
    };
    ExecutionTrace trace = grove::detail::simulate(order_, durations());
    std::vector<BlockedRobot> blocked_robots = grove::detail::blocked_robots(order_, trace);
    if (blocked_robots.empty()) fixed_.add(order_, trace);
    if (a_.switches) {
      SwitchableTrace switched = simulate_switchable(loaded_.instance.world(),
                                                     *claimed_.solution.plan, order_, durations());
      trace = std::move(switched.trace);
      blocked_robots = std::move(switched.blocked_robots);
      switches_ += switched.switches;
      if (blocked_robots.empty()) switching_.add(order_, trace);
    }
    if (seed == a_.seed) show(trace, blocked_robots);
    if (blocked_robots.empty()) return require_valid(trace);
    if (unfinished_++ > 0) return;
    first_stuck_ = std::move(blocked_robots);
    first_stuck_seed_ = seed;
  }

  Solution solution_of(const ExecutionTrace& trace) const {
    Solution solution;
    solution.plan = executed_plan(loaded_.instance, *claimed_.solution.plan, order_, trace);
    solution.lower_bound = 0;
    // An execution contains following conflicts only if the plan does.
    solution.may_follow = claimed_.solution.may_follow;
    solution.status = status_of(solution.plan->cost, 0, solution.omega);
    solution.stats.texts["executed"] = a_.plan;
    solution.stats.texts["options"] = options_;
    return solution;
  }

  void show(const ExecutionTrace& trace, const std::vector<BlockedRobot>& blocked_robots) const {
    const Solution executed = solution_of(trace);
    if (!a_.output.empty() && blocked_robots.empty())
      write(a_.output, solution_text(loaded_.instance, executed));
    else if (!a_.output.empty())
      print_warnings(
          {fmt::format("{} is not written: not all robots reach their end, so the execution "
                       "is not a plan",
                       a_.output)});
    if (a_.view.empty()) return;
    const std::string name_of_drive =
        blocked_robots.empty() ? "driven"
                               : fmt::format("driven, {} of {} robots do not reach their end",
                                             blocked_robots.size(), order_.agent_count());
    const std::vector<NamedPlan> plans{
        {"planned", claimed_}, {name_of_drive, {executed, {"lower bound", "order of tasks"}}}};
    const std::string name = std::filesystem::path(a_.instance.name()).filename().string();
    write(a_.view, plan_page(name, page_data(name, loaded_.instance, plans)));
  }

  // Checks the execution with the independent checker, because a collision is an error in Grove.
  void require_valid(const ExecutionTrace& trace) const {
    require_valid_plan(loaded_.instance, solution_of(trace));
  }

  void report_blocked_robots() const {
    const auto id = [&](AgentIndex agent) { return one_line(loaded_.instance.agent(agent).id); };
    const std::string which =
        a_.runs == 1 ? ""
                     : fmt::format("{} of {} executions do not end; in the one with --seed {} ",
                                   unfinished_, a_.runs, first_stuck_seed_);
    fmt::print("{}{} of {} robots do not reach their end:\n", which, first_stuck_.size(),
               order_.agent_count());
    for (std::size_t i = 0; i < std::min(first_stuck_.size(), kMaxStuckShown); ++i) {
      const BlockedRobot& s = first_stuck_[i];
      if (s.agent == s.waits_for)
        fmt::print("  {} has failed\n", id(s.agent));
      else
        fmt::print("  {} waits for {}\n", id(s.agent), id(s.waits_for));
    }
    if (first_stuck_.size() > kMaxStuckShown)
      fmt::print("  and {} more\n", first_stuck_.size() - kMaxStuckShown);
  }

  void print() {
    const Plan& plan = *claimed_.solution.plan;
    Totals undisturbed;
    undisturbed.add(order_, simulate_nominal(order_));
    const Cost makespan = std::ranges::max(plan.agents, {}, &AgentPlan::cost).cost;
    fmt::print("passing order: {} actions, {} waits between robots, {} rings\n",
               order_.actions().size(), order_.dependency_count(), order_.rings());
    fmt::print("{:<27}{:>10}{:>14}\n", "", "makespan", "sum of costs");
    fmt::print("{:<27}{:>10}{:>14}\n", "planned", makespan, plan.cost);
    row("driven undisturbed", undisturbed, plan.cost, makespan);
    if (!fixed_.costs.empty()) row("driven", fixed_, plan.cost, makespan);
    if (!switching_.costs.empty()) row("driven, switching", switching_, plan.cost, makespan);
  }

  static void row(const std::string& name, Totals& took, Cost cost, Cost makespan) {
    const auto middle = [](std::vector<Cost>& all) {
      std::ranges::sort(all);
      return all[all.size() / 2];
    };
    const auto more = [](Cost now, Cost before) {
      return before == 0 ? 0.0
                         : 100.0 * static_cast<double>(now - before) / static_cast<double>(before);
    };
    const Cost m = middle(took.makespans);
    const Cost c = middle(took.costs);
    fmt::print("{:<27}{:>10}{:>14}   {:+.1f} %, {:+.1f} %\n",
               took.costs.size() > 1 ? name + ", median" : name, m, c, more(m, makespan),
               more(c, cost));
    if (took.costs.size() > 1)
      fmt::print("{:<27}{:>10}{:>14}   {:+.1f} %, {:+.1f} %\n", name + ", worst",
                 took.makespans.back(), took.costs.back(), more(took.makespans.back(), makespan),
                 more(took.costs.back(), cost));
  }

  const ExecuteArguments& a_;
  const std::string options_;
  const LoadedInstance loaded_;
  const ClaimedPlan claimed_;
  const ActionDependencyGraph order_;
  Totals fixed_;
  Totals switching_;
  std::int64_t switches_ = 0;
  std::int64_t unfinished_ = 0;  // executions in which a robot does not reach its end
  std::vector<BlockedRobot> first_stuck_;
  std::int64_t first_stuck_seed_ = 0;
};

}  // namespace

void add_execute_command(CLI::App& app) {
  const auto arguments = std::make_shared<ExecuteArguments>();
  CLI::App* command = app.add_subcommand("execute", "Simulate the execution of a plan with delays");
  command->footer(kExecuteFooter);
  arguments->instance.add_to(*command);
  command->add_option("PLAN", arguments->plan, "plan file, or paths of another solver")
      ->required()
      ->type_name("");
  DisturbanceArguments& t = arguments->troubles;
  add_number(*command, "--delays", t.delayed, 0, 1,
             "share of actions that take longer, from 0 to 1");
  add_integer(*command, "--delay-steps", t.delay_steps, kDelaySteps,
              "maximum delay of an action, steps; drawn from 1 to N");
  add_repeated(*command, "--slow", t.slow, "ROBOT=FACTOR",
               "robot whose actions take FACTOR times as long (repeatable)");
  add_repeated(*command, "--stop", t.stop, "ROBOT@TIME=STEPS",
               "robot that stops at TIME for STEPS steps (repeatable)");
  add_repeated(*command, "--dies", t.failures, "ROBOT@TIME", "deprecated name of --fail")
      ->group("");
  add_repeated(*command, "--fail", t.failures, "ROBOT@TIME",
               "robot that fails at TIME and does not move again (repeatable)");
  command->add_flag("--switch", arguments->switches,
                    "let a robot that waits for a late one go first if that saves time");
  add_integer(*command, "--runs", arguments->runs, kRuns,
              "number of executions, each with other delays");
  add_integer(*command, "--seed", arguments->seed, kSeeds,
              "seed of the delays of the first execution");
  command->add_option("--order", arguments->order, "write the passing order to this file")
      ->type_name("FILE.json");
  arguments->frame.add_to(*command);
  command
      ->add_option("-o,--output", arguments->output,
                   "write the first execution as a plan to this file")
      ->type_name("PLAN");
  command
      ->add_option("--view", arguments->view,
                   "write a page with the plan and the first execution side by side")
      ->type_name("FILE.html");
  command->callback([command, arguments] {
    if (arguments->frame.given() && arguments->order.empty())
      throw CLI::ValidationError("--cell-size, --origin", "allowed only with --order");
    if (command->count("--delay-steps") > 0 && command->count("--delays") == 0)
      throw CLI::ValidationError("--delay-steps", "allowed only with --delays");
    Execution(*command, *arguments).run();
  });
}

}  // namespace grove::detail
