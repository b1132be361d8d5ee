// SPDX-License-Identifier: MIT
// grove replan INSTANCE PLAN --at T: what is left to do then, and another plan of it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "grove/detail/engine/session.h"
#include "grove/detail/io/atomic_file.h"
#include "grove/detail/io/input_error.h"
#include "grove/detail/io/instance_file.h"
#include "grove/detail/io/map_file.h"
#include "grove/detail/io/roadmap_file.h"
#include "grove/detail/io/text_file.h"
#include "grove/session.hpp"
#include "tools/common/commands.h"
#include "tools/common/file_formats.h"
#include "tools/common/options.h"
#include "tools/common/signals.h"
#include "tools/common/standard_error.h"
#include "tools/execute/robots.h"
#include "tools/generate/generate_commands.h"
#include "tools/replan/change_arguments.h"
#include "tools/solve/solve_arguments.h"
#include "tools/solve/solve_run.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr IntegerRange kTimes{0, 1'000'000};

constexpr const char* kReplanFooter =
    R"(The instance as it is after T steps of the plan - where everybody stands, on a road, within a turn or
at work, and what has been visited - with what has changed since, and a plan of it, both with times
from 0. The search starts from the old plan; who has other tasks, or whose way is closed, is planned
anew around the others. The bound is proven as always.

--late r3=5: r3 is where the plan had it five steps before T, and the others where the passing order
then lets them be (see 'grove execute --help').

--commit K: while the new plan is being found robots go on. All keep to the first K steps of the old
plan, and the new one begins with them: late or not, who has done some of these can go on with it. If
robots do more in that time, K is too small. (A plan file that is there is then replaced, by a costlier
plan too, for it need not begin with these steps.)

NEW TASKS are a task as in an instance, {"id": "t9", "cell": [3, 4], "agents": ["r0"]}, or several,
{"tasks": [...]}.

Examples:
  grove replan my.cts.json my.plan.json --at 20 --late r3=5
  grove replan my.cts.json my.plan.json --at 20 --new-task t9.json --commit 3 --time-limit 0.2
  grove replan my.cts.json my.plan.json --at 20 --blocked 7,4 --drop-task t2 -o now.plan.json)";

struct ReplanArguments {
  SolveArguments solve;
  std::string plan;
  std::int64_t at = 0;
  std::int64_t commit = 0;
  ChangeArguments change;
  fs::path output_instance;
};

class Replanning {
 public:
  Replanning(const CLI::App& app, ReplanArguments& arguments)
      : app_(app),
        a_(arguments),
        options_(options_of_one_search(a_.solve)),
        loaded_(a_.solve.instance.load()),
        session_(loaded_.instance, *read_plan_to_drive(a_.plan, loaded_.instance).solution.plan) {}

  void run() {
    advance();
    change();
    name_outputs();
    solve();
  }

 private:
  void advance() {
    const std::vector<Late> late = late_robots(a_.change, loaded_.instance);
    try {
      session_.advance(static_cast<Time>(a_.at), late);
    } catch (const ImpossibleLateness& error) {
      throw CLI::ValidationError("--late", one_line(error.what()));
    }
  }

  void change() {
    const AskedChange asked(a_.change, session_.instance());
    try {
      session_.change(asked.change());
    } catch (const InstanceError& error) {
      asked.refuse(error);
    }
  }

  void name_outputs() {
    SolveArguments& s = a_.solve;
    s.keeps_cheaper = a_.commit == 0;  // others need not begin with the committed steps
    const std::string stem = fmt::format("{}-at-{}", s.instance.stem(), a_.at);
    if (a_.output_instance.empty()) a_.output_instance = stem + ".cts.json";
    if (s.output.empty()) s.output = stem + ".plan.json";
    prepare_outputs(s, loaded_);
    for (const fs::path& file :
         {s.instance.path(), loaded_.map_path, fs::path(a_.plan), s.output, fs::path(s.log)})
      require_distinct_files(a_.output_instance, file, "another file of this run");
    require_distinct_files(s.output, a_.plan, "the plan that is being driven");
    require_writable(a_.output_instance);
  }

  // A map on which something is closed is written beside the instance.
  void write_instance_then() const {
    const Instance& now = session_.instance();
    const bool is_closed = !a_.change.blocked.empty();
    std::string map = loaded_.map_path.string();
    if (is_closed || map.empty()) {
      map = without_suffix(a_.output_instance.string()) +
            (now.is_on_grid() ? ".map" : ".roadmap.json");
      require_distinct_files(map, loaded_.map_path, "the map");
      if (now.is_on_grid())
        write_map(map, now.grid());
      else
        write_roadmap(map, *now.roadmap());
    }
    const std::string text = instance_text(now, map_as_seen_from(a_.output_instance, map));
    tell_if_another_is_replaced(text);
    write_file_atomically(a_.output_instance, text);
  }

  // Plans of that one are then none of this.
  void tell_if_another_is_replaced(const std::string& text) const {
    if (!fs::exists(a_.output_instance) || read_text(a_.output_instance) == text) return;
    say_on_stderr(fmt::format(
        "grove: {} held another instance, of which plans are none of this one; --output-instance "
        "names another file",
        a_.output_instance.string()));
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
    if (solution.stats.counts.contains("lower_bound_committed")) tell_committed(solution, *log);
    write_instance_then();
    finish_run(s, now.instance, solution, *log);
    if (s.require_plan && !solution.plan) throw CommandFailed(kExitNoPlan);
  }

  Solution solve_session(const Limits& limits, RunLog& rows) {
    try {
      return session_.solve(options_, limits, &rows, static_cast<Time>(a_.commit));
    } catch (const Session::NotCommitted& error) {
      throw CLI::ValidationError(
          "--commit",
          fmt::format("found {}; expected {} at most, for '{}' comes then to what is "
                      "blocked",
                      a_.commit, error.steps, one_line(loaded_.instance.agent(error.agent).id)));
    }
  }

  void tell_committed(const Solution& solution, LogFormat& log) const {
    log.note(fmt::format("of plans that begin with the {} committed steps none costs less than {}",
                         a_.commit, solution.stats.counts.at("lower_bound_committed")),
             std::chrono::duration<double>(Clock::now() - start_).count());
  }

  const CLI::App& app_;
  ReplanArguments& a_;
  const Clock::time_point start_ = Clock::now();
  const SolveOptions options_;
  const LoadedInstance loaded_;
  Session session_;
};

void add_several(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                 const std::string& type, const std::string& description) {
  app.add_option(name, values, description)
      ->type_name(type)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

void add_replan_command(CLI::App& root) {
  CLI::App* app = root.add_subcommand("replan", "Change a plan that is being driven");
  app->footer(kReplanFooter);
  const auto arguments = std::make_shared<ReplanArguments>();
  ReplanArguments& a = *arguments;
  a.solve.instance.add_to(*app);
  app->add_option("PLAN", a.plan,
                  "the plan that is being driven: a plan file, or another "
                  "solver's paths")
      ->required()
      ->type_name("");
  add_integer(*app, "--at", a.at, kTimes, "how many steps of the plan have passed")->required();
  add_several(*app, "--late", a.change.late, "ROBOT=STEPS",
              "a robot that is where the plan had it so many steps ago");
  add_several(*app, "--new-task", a.change.new_tasks, "FILE.json", "tasks that have come");
  add_several(*app, "--drop-task", a.change.dropped, "ID", "a task that nobody has to visit now");
  add_several(*app, "--blocked", a.change.blocked, "X,Y",
              "a cell that is closed; on a roadmap a vertex, or A,B: a road");
  add_integer(*app, "--commit", a.commit, kTimes, "so many steps of the old plan that all keep to");
  app->add_option("--output-instance", a.output_instance,
                  "the instance then; by default the old one's name with -at-T.cts.json")
      ->type_name("FILE");
  app->add_option("-o,--output", a.solve.output,
                  "the plan file; by default the old instance's name with -at-T.plan.json; - is "
                  "standard output")
      ->type_name("PLAN");
  app->add_flag("--require-plan", a.solve.require_plan,
                "end with exit code 3 if no plan was found");
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
