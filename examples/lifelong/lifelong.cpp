// SPDX-License-Identifier: MIT
// grove-lifelong: a loop over a Session. Errands arrive all the time; at each decision free robots
// are given the oldest ones, and all are planned anew for what has changed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "examples/lifelong/assignment.h"
#include "grove/detail/engine/session.h"
#include "grove/detail/io/input_error.h"
#include "grove/detail/io/map_file.h"

namespace grove::detail::lifelong {
namespace {

using Clock = std::chrono::steady_clock;

struct Asked {
  std::string map;
  int robots = 200;
  int tasks = 1000;
  Time steps = 2000;
  Time every = 1;
  double think_s = 0.1;
  std::uint64_t seed = 0;
  Time turn_steps = 0;
};

struct Report {
  int done = 0;
  int done_by_the_end_of_arrivals = 0;
  Cost waited = 0;  // from arrival to visit, summed
  Time last = 0;
  int decisions = 0;
  int without_plan = 0;
  std::vector<double> seconds;  // of each decision
};

Instance standing(const Grid& grid, const Asked& asked) {
  InstanceBuilder builder{Map(grid)};
  int robot = 0;
  for (const Cell cell : random_starts(grid, asked.robots, asked.seed))
    builder.add_agent({.id = fmt::format("r{}", robot++),
                       .start = {.place = cell},
                       .goal = {},
                       .motion = {asked.turn_steps}});
  return std::move(builder).build();
}

class Loop {
 public:
  Loop(const Grid& grid, const Asked& asked)
      : asked_(asked),
        errands_(random_errands(grid, asked.tasks, asked.steps, asked.seed)),
        assignment_(grid),
        session_(standing(grid, asked)) {
    Limits limits;
    session_.solve(options(), limits);  // all stand still, for there is nothing to do
  }

  Report run() {
    for (now_ = 0; report_.done < asked_.tasks && now_ < 50 * asked_.steps; ++now_) {
      for (; next_ < errands_.size() && errands_[next_].arrives <= now_; ++next_)
        assignment_.add(errands_[next_]);
      if (now_ % asked_.every == 0) decide();
      step();
    }
    return report_;
  }

 private:
  using Given = std::vector<std::pair<AgentIndex, Errand>>;

  static SolveOptions options() {
    SolveOptions options;
    options.omega = Omega::parse("0.01");
    return options;
  }

  void decide() {
    Given given = assignment_.give(session_.instance());
    give_back(given, at_once_);
    if (given.empty()) return;
    const auto start = Clock::now();
    take_on(given);
    const bool is_planned = solve(start);
    if (!is_planned) do_without(given);
    // So many new ways at a time as are found in time.
    at_once_ =
        is_planned ? at_once_ + at_once_ / 4 + 1 : std::max<std::size_t>(1, given.size() / 2);
    at_once_ = std::min<std::size_t>(at_once_, static_cast<std::size_t>(asked_.robots));
    ++report_.decisions;
    report_.seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }

  void take_on(const Given& given) {
    InstanceChange change;
    for (const auto& [robot, errand] : given) {
      const std::string id = std::to_string(errand.id);
      change.new_tasks.push_back({id, errand.cell, {session_.instance().agent(robot).id}});
      arrived_[id] = errand.arrives;
    }
    session_.change(change);
  }

  // All but the first `kept`, for another time.
  void give_back(Given& given, std::size_t kept) {
    for (std::size_t i = kept; i < given.size(); ++i) assignment_.add(given[i].second);
    given.resize(std::min(kept, given.size()));
  }

  bool solve(Clock::time_point start) {
    Limits limits;
    limits.set_deadline(start + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(asked_.think_s)));
    return session_.solve(options(), limits).plan.has_value();
  }

  // Nobody knew a way in time: another time.
  void do_without(const Given& given) {
    ++report_.without_plan;
    InstanceChange change;
    for (const auto& [robot, errand] : given) {
      change.dropped_tasks.push_back(std::to_string(errand.id));
      assignment_.add(errand);
    }
    session_.change(change);
    SolveOptions any = options();
    any.omega = Omega::infinite();
    Limits patient;
    patient.set_deadline(Clock::now() + std::chrono::minutes(1));
    if (!session_.solve(any, patient).plan)
      throw std::runtime_error("no plan in a minute, though there was one before");
  }

  // One step of all, and who has been where it was to go.
  void step() {
    std::map<std::string, bool> left;
    for (const Task& task : session_.instance().tasks()) left[task.id] = true;
    session_.advance(1);
    for (const Task& task : session_.instance().tasks()) left[task.id] = false;
    for (const auto& [id, is_done] : left) {
      if (!is_done) continue;
      ++report_.done;
      report_.done_by_the_end_of_arrivals += now_ + 1 <= asked_.steps ? 1 : 0;
      report_.waited += now_ + 1 - arrived_.at(id);
      report_.last = now_ + 1;
    }
  }

  const Asked& asked_;
  const std::vector<Errand> errands_;
  std::size_t next_ = 0;
  Assignment assignment_;
  std::size_t at_once_ = 1'000'000;  // errands given in one decision, at most
  Session session_;
  Time now_ = 0;
  std::map<std::string, Time> arrived_;  // by task
  Report report_;
};

void print(const Asked& asked, Report report) {
  std::ranges::sort(report.seconds);
  const auto at = [&](double part) {
    return report.seconds.empty()
               ? 0.0
               : 1000 * report.seconds[static_cast<std::size_t>(
                            part * static_cast<double>(report.seconds.size() - 1))];
  };
  fmt::print("{} of {} errands done, {} of them within {} steps, the last at {}\n", report.done,
             asked.tasks, report.done_by_the_end_of_arrivals, asked.steps, report.last);
  fmt::print("from arrival to visit: {:.1f} steps on average\n",
             static_cast<double>(report.waited) / std::max(1, report.done));
  fmt::print(
      "{} decisions, {} without a plan in time; median {:.1f} ms, 95 % {:.1f}, worst {:.1f}\n",
      report.decisions, report.without_plan, at(0.5), at(0.95), at(1));
}

int main(int argc, char** argv) {
  CLI::App app("Robots that are given errands as they arrive", "grove-lifelong");
  Asked asked;
  app.add_option("MAP", asked.map, "a Moving AI map")->required();
  app.add_option("--robots", asked.robots)->capture_default_str();
  app.add_option("--tasks", asked.tasks, "errands that arrive")->capture_default_str();
  app.add_option("--steps", asked.steps, "over so many steps")->capture_default_str();
  app.add_option("--every", asked.every, "steps between decisions")->capture_default_str();
  app.add_option("--think", asked.think_s, "seconds for each")->capture_default_str();
  app.add_option("--turn-steps", asked.turn_steps, "of a quarter turn; 0: robots turn freely")
      ->capture_default_str();
  app.add_option("--seed", asked.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    const Grid grid = read_map(asked.map);
    print(asked, Loop(grid, asked).run());
    return 0;
  } catch (const InputError& error) {
    fmt::print(stderr, "grove-lifelong: error: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "grove-lifelong: {}\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace grove::detail::lifelong

int main(int argc, char** argv) {
  return grove::detail::lifelong::main(argc, argv);
}
