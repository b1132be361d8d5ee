// SPDX-License-Identifier: MIT
// grove replan: computes the remainder of an instance at a time of its plan, and a new plan for it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/session.h"
#include "grove/session.hpp"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/instance_file.h"
#include "io/map_file.h"
#include "io/roadmap_file.h"
#include "io/text_file.h"
#include "tools/common/commands.h"
#include "tools/common/options.h"
#include "tools/common/signals.h"
#include "tools/common/standard_error.h"
#include "tools/execute/robots.h"
#include "tools/generate/generate_commands.h"
#include "tools/replan/change_arguments.h"
#include "tools/solve/plan_output.h"
#include "tools/solve/solve_arguments.h"
#include "tools/solve/solve_run.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kInstanceSuffix = ".cts.json";
constexpr const char* kPlanSuffix = ".plan.json";

constexpr const char* kReplanFooter =
    R"(Writes the instance as it is after T steps of the plan, with all changes, and a plan of it, both
with times from 0. The instance has the position of each robot (on a road, within a turn or at work
as well) and the remaining tasks. The search starts from the old plan. Robots with other tasks, or
with a closed path, are planned again around the others. The bound is proven as in 'grove solve'.

Robots without a destination still have none: they end on a remaining task, or anywhere if none
remains. If no plan as good as the old one is found this way, the end of the old plan becomes the
destination, and the output says so. A plan without following is replaced by one without.

--late r3=5: r3 is where the plan had it five steps before T; the others are where the passing order
then allows (see 'grove execute --help').

--commit K: robots continue while the new plan is computed. All follow the first K steps of the old
plan, and the new plan begins with these steps. A robot that has done some of them, late or not, can
continue with the new plan. If robots do more than K steps in that time, K is too small. (An
existing plan file is then replaced even by a plan of higher cost, because the existing plan need
not begin with these steps.)

FILE.json of --new-task has a task as in an instance, {"id": "t9", "cell": [3, 4], "agents":
["r0"]}, or several, {"tasks": [...]}.

Examples:
  grove replan my.cts.json my.plan.json --at 20 --late r3=5
  grove replan my.cts.json my.plan.json --at 20 --new-task t9.json --commit 3 --time-limit 0.2
  grove replan my.cts.json my.plan.json --at 20 --blocked 7,4 --drop-task t2 -o now.plan.json)";

struct ReplanArguments {
  SolveArguments solve;
  std::string plan;
  std::int64_t at = 0;
  std::int64_t commit = 0;
  std::int64_t visit_weight = 0;
  ChangeArguments change;
  fs::path output_instance;
};

SolveOptions options_of(const ReplanArguments& arguments) {
  SolveOptions options = options_of_one_search(arguments.solve);
  options.visit_weight = static_cast<int>(arguments.visit_weight);
  return options;
}

class Replanning {
 public:
  Replanning(const CLI::App& app, ReplanArguments& arguments)
      : app_(app),
        a_(arguments),
        options_(options_of(a_)),
        loaded_(load(a_.solve)),
        plan_(read_plan()),
        session_(loaded_.instance, plan_) {}

  void run() {
    advance();
    change();
    name_outputs();
    solve();
  }

 private:
  // Reads the plan. If its file claims that it contains no following conflicts, forbids them in the
  // instance and therefore in the new plan.
  Plan read_plan() {
    Solution driven = read_plan_to_execute(a_.plan, loaded_.instance).solution;
    if (!driven.may_follow) loaded_.instance = loaded_.instance.without_following();
    return *std::move(driven.plan);
  }

  // Refuses a time after the end of the plan, because all robots then rest forever.
  void require_time_of_plan() const {
    const Time end = std::ranges::max(plan_.agents, {}, &AgentPlan::cost).cost;
    if (a_.at > end)
      throw CLI::ValidationError(
          "--at",
          fmt::format("found {}; expected at most {}, the time at which the last robot of the plan "
                      "comes to rest",
                      a_.at, end));
  }

  void advance() {
    require_time_of_plan();
    const std::vector<Delay> late = late_robots(a_.change, loaded_.instance);
    try {
      session_.advance(static_cast<Time>(a_.at), late);
    } catch (const InfeasibleDelay& error) {
      throw CLI::ValidationError("--late", one_line(error.what()));
    } catch (const InstanceError& error) {  // delays with choices: too many visits of an agent
      throw CLI::ValidationError("--late", one_line(error.what()));
    }
  }

  void change() {
    const RequestedChange asked(a_.change, session_.instance());
    if (!a_.solve.quiet) print_hints(asked.hints());
    try {
      session_.change(asked.change());
    } catch (const InstanceError& error) {
      asked.refuse(error);
    }
  }

  void name_outputs() {
    SolveArguments& s = a_.solve;
    // With --commit, a cheaper existing plan may not start with the committed steps.
    s.keeps_cheaper = a_.commit == 0;
    const std::string stem = fmt::format("{}-at-{}", s.instance.stem(), a_.at);
    const bool names_plan = !s.output.empty() && is_name_of_file(s.output);
    const bool names_instance = !a_.output_instance.empty();
    if (!names_instance)
      a_.output_instance = (names_plan ? stem_of(s.output) : stem) + kInstanceSuffix;
    if (s.output.empty())
      s.output = (names_instance ? stem_of(a_.output_instance) : stem) + kPlanSuffix;
    locks_ = prepare_outputs(s, loaded_);
    require_distinct_outputs();
    require_writable(a_.output_instance);
  }

  static bool is_name_of_file(const fs::path& output) {
    return output != kStandardOutput && (!fs::exists(output) || fs::is_regular_file(output));
  }

  // Returns the path without its suffix: "hall" for "hall.plan.json" and "hall.cts.json".
  static std::string stem_of(const fs::path& file) {
    const std::string name = file.string();
    for (const std::string_view suffix : {kPlanSuffix, kInstanceSuffix, ".json"})
      if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
    return name;
  }

  // Requires that the output files are distinct and are not input files.
  void require_distinct_outputs() const {
    const SolveArguments& s = a_.solve;
    std::vector<fs::path> written{a_.output_instance, changed_map(), fs::path(s.log)};
    if (s.output != kStandardOutput) written.push_back(s.output);
    for (std::size_t i = 0; i < written.size(); ++i) {
      require_distinct_files(written[i], s.instance.path(), "the instance");
      require_distinct_files(written[i], loaded_.map_path, "the map");
      require_distinct_files(written[i], a_.plan, "the plan that is being executed");
      for (const std::string& tasks : a_.change.new_tasks)
        require_distinct_files(written[i], tasks, "a file of new tasks");
      for (std::size_t k = 0; k < i; ++k)
        require_distinct_files(written[i], written[k], "another file of this run");
    }
  }

  // Returns the path, beside the new instance, for its map; "" if the new instance uses the map
  // file of the old one. It needs a new file if places are blocked, or if the old instance has no
  // map file.
  fs::path changed_map() const {
    if (a_.change.blocked.empty() && !loaded_.map_path.empty()) return {};
    return stem_of(a_.output_instance) +
           (session_.instance().is_on_grid() ? ".map" : ".roadmap.json");
  }

  void write_remaining_instance() const {
    const Instance& now = session_.instance();
    const fs::path map = changed_map();
    if (!map.empty()) {
      const std::string before = fs::exists(map) ? read_text(map) : "";
      if (now.is_on_grid())
        write_map(map, now.grid());
      else
        write_roadmap(map, *now.roadmap());
      if (!before.empty() && read_text(map) != before) report_replaced(map, "map");
    }
    const std::string text = instance_text(
        now, map_as_seen_from(a_.output_instance, (map.empty() ? loaded_.map_path : map).string()));
    if (fs::exists(a_.output_instance) && read_text(a_.output_instance) != text)
      report_replaced(a_.output_instance, "instance");
    write_file_atomically(a_.output_instance, text);
  }

  // Reports that plans for the replaced file are not valid for the new one.
  static void report_replaced(const fs::path& file, const std::string& what) {
    print_to_stderr(fmt::format(
        "grove: {} had another {} and was replaced; plans of that one are not valid for this one; "
        "to keep it, give another name with --output-instance",
        file.string(), what));
  }

  // Reports agents whose destination is now the end of the old plan. The lower bound then holds for
  // this more constrained instance; see docs/engineers.md.
  static void report_ends_of_old_plan(const Solution& solution) {
    const auto ends = solution.stats.texts.find("ends_of_old_plan");
    if (ends == solution.stats.texts.end()) return;
    print_to_stderr(
        fmt::format("grove: the end of the old plan is now the destination of {}: no plan as good "
                    "was found that "
                    "ends on a remaining task; bound and status are of this instance",
                    one_line(ends->second)));
  }

  void solve() {
    SolveArguments& s = a_.solve;
    const auto log = open_log(s);
    LoadedInstance now{session_.instance(), loaded_.map_path, {}};
    LogHead head = head_of(app_, s, now, std::to_string(s.threads));
    head.instance = a_.output_instance.string();
    log->head(head);
    Limits limits;
    set_limits(limits, s, start_);
    RunLog rows = rows_of(*log, s, start_);
    Solution solution = solve_session(limits, rows);
    add_run_facts(solution, app_, s, start_);
    solution.stats.texts["instance"] = head.instance;
    if (solution.stats.counts.contains("lower_bound_committed"))
      report_committed_bound(solution, *log);
    write_remaining_instance();
    report_ends_of_old_plan(solution);
    report_failures({finish_run(s, session_.instance(), solution, *log)});
    if (s.require_plan && !solution.plan) throw CommandFailed(kExitNoPlan);
  }

  Solution solve_session(const Limits& limits, RunLog& rows) {
    try {
      return session_.solve(options_, limits, &rows, static_cast<Time>(a_.commit));
    } catch (const Session::NotCommitted& error) {
      throw CLI::ValidationError(
          "--commit",
          fmt::format("found {}; expected at most {}, because '{}' then comes to a blocked "
                      "place",
                      a_.commit, error.steps, one_line(loaded_.instance.agent(error.agent).id)));
    }
  }

  void report_committed_bound(const Solution& solution, LogFormat& log) const {
    log.note(fmt::format("no plan that begins with the {} committed steps costs less than {}",
                         a_.commit, solution.stats.counts.at("lower_bound_committed")),
             std::chrono::duration<double>(Clock::now() - start_).count());
  }

  const CLI::App& app_;
  ReplanArguments& a_;
  const Clock::time_point start_ = Clock::now();
  const SolveOptions options_;
  LoadedInstance loaded_;
  const Plan plan_;
  Session session_;
  std::vector<OutputLock> locks_;
};

}  // namespace

void add_replan_command(CLI::App& root) {
  CLI::App* app = root.add_subcommand("replan", "Change a plan during its execution");
  app->footer(kReplanFooter);
  const auto arguments = std::make_shared<ReplanArguments>();
  ReplanArguments& a = *arguments;
  a.solve.instance.add_to(*app);
  app->add_option("PLAN", a.plan,
                  "plan that is being executed: a plan file, or paths of another solver")
      ->required()
      ->type_name("");
  add_integer(*app, "--at", a.at, kPlanSteps,
              "T: steps since the start of the plan, also for robots that are late")
      ->required();
  add_repeated(*app, "--late", a.change.late, "ROBOT=STEPS",
               "robot that is where the plan had it STEPS steps ago (repeatable)");
  add_repeated(*app, "--new-task", a.change.new_tasks, "FILE.json",
               "file with new tasks (repeatable)");
  add_repeated(*app, "--drop-task", a.change.dropped, "ID",
               "task that is no longer to be visited (repeatable)");
  add_repeated(*app, "--blocked", a.change.blocked, "X,Y",
               "cell that is blocked; on a roadmap a vertex, or A,B: a road (repeatable)");
  add_integer(*app, "--commit", a.commit, kPlanSteps,
              "number of steps of the old plan that all robots still follow");
  add_integer(*app, "--visit-weight", a.visit_weight, {0, SolveOptions::kMaxVisitWeight},
              "with tasks that only some of their robots must visit: weight of the times of these "
              "visits against the cost; 10: tasks are visited early");
  app->add_option("--output-instance", a.output_instance,
                  "file for the remaining instance; default: name of the plan file, with .cts.json")
      ->type_name("FILE");
  app->add_option("-o,--output", a.solve.output,
                  "plan file; default: like the instance file, or like the old plan with "
                  "-at-T.plan.json; -: standard output")
      ->type_name("PLAN");
  app->add_flag("--require-plan", a.solve.require_plan, "exit with code 3 if no plan was found");
  a.solve.time_limit_s = *grove::Session::default_options().time_limit;
  add_search_options(*app, a.solve);
  a.solve.instance.add_rules_to(*app);
  add_log_options(*app, a.solve);
  app->callback([app, arguments] {
    stop_on_signals();
    Replanning(*app, *arguments).run();
  });
}

}  // namespace grove::detail
