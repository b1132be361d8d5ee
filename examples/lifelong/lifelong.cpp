// SPDX-License-Identifier: MIT
// grove-lifelong: a control loop around a Session. Errands arrive continuously. At each decision
// the loop assigns open errands to robots without a task and re-plans.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <grove/grove.hpp>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "assignment.h"
#include "errands.h"

namespace lifelong {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kOmega = 0.01;
constexpr double kPatientSeconds = 60;

constexpr const char* kUsage =
    R"(usage: grove-lifelong MAP [--OPTION NUMBER]...

Assigns errands to robots as they arrive, on a Moving AI map.

  --robots N      robots (default: 200)
  --tasks N       errands that arrive (default: 1000)
  --steps N       steps over which they arrive (default: 2000)
  --every N       steps between decisions (default: 1)
  --think S       seconds for each decision (default: 0.1)
  --turn-steps N  steps of a quarter turn; 0: robots turn freely (default: 0)
  --seed N        seed of errands and starts (default: 0)
)";

struct BadUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Arguments {
  std::string map;
  int robots = 200;
  int tasks = 1000;
  int steps = 2000;
  int every = 1;
  double think_s = 0.1;
  int turn_steps = 0;
  int seed = 0;
};

double number(const std::string& option, const std::string& text, double least, double most) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most))
    throw BadUsage(option + ": found '" + text + "'; expected a number from " +
                   std::to_string(static_cast<int>(least)));
  return value;
}

int integer(const std::string& option, const std::string& text, int least) {
  const double value = number(option, text, least, std::numeric_limits<int>::max());
  if (value != static_cast<int>(value)) throw BadUsage(option + ": expected a whole number");
  return static_cast<int>(value);
}

Arguments parse_arguments(const std::vector<std::string>& words) {
  Arguments arguments;
  const std::map<std::string, std::pair<int*, int>> integers{
      {"--robots", {&arguments.robots, 1}}, {"--tasks", {&arguments.tasks, 1}},
      {"--steps", {&arguments.steps, 1}},   {"--every", {&arguments.every, 1}},
      {"--seed", {&arguments.seed, 0}},     {"--turn-steps", {&arguments.turn_steps, 0}}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("--")) {
      if (!arguments.map.empty()) throw BadUsage("found two maps; expected one");
      arguments.map = words[i];
      continue;
    }
    const std::string& option = words[i];
    const auto found = integers.find(option);
    if (found == integers.end() && option != "--think") throw BadUsage(option + ": no such option");
    if (++i == words.size()) throw BadUsage(option + ": expected a number after it");
    if (found == integers.end())
      arguments.think_s = number(option, words[i], 0, 1e6);
    else
      *found->second.first = integer(option, words[i], found->second.second);
  }
  if (arguments.map.empty()) throw BadUsage("expected a MAP");
  return arguments;
}

struct Report {
  int done = 0;
  int done_by_the_end_of_arrivals = 0;
  long waited = 0;  // sum over the done errands of the steps from arrival to visit
  int last = 0;
  int decisions = 0;
  int without_plan = 0;
  std::vector<double> seconds;  // computation time of each decision
};

// Returns the instance with all robots at their starts and no tasks.
grove::Instance idle_instance(const grove::World& world, const Arguments& arguments) {
  std::vector<grove::Agent> robots;
  for (const grove::Cell cell :
       random_starts(world, arguments.robots, static_cast<std::uint64_t>(arguments.seed))) {
    grove::Agent robot{.id = "r" + std::to_string(robots.size()),
                       .start = {cell},
                       .turn_steps = arguments.turn_steps};
    if (arguments.turn_steps > 0) robot.start.heading = grove::Heading::north;
    robots.push_back(std::move(robot));
  }
  return {world, std::move(robots), {}};
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Loop {
 public:
  Loop(const grove::World& world, const Arguments& arguments)
      : arguments_(arguments),
        errands_(random_errands(world, arguments.tasks, arguments.steps,
                                static_cast<std::uint64_t>(arguments.seed))),
        assignment_(world),
        session_(idle_instance(world, arguments)) {
    session_.replan();  // gives a plan in which no robot moves
  }

  Report run() {
    for (now_ = 0; report_.done < arguments_.tasks && now_ < 50 * arguments_.steps; ++now_) {
      for (; next_ < errands_.size() && errands_[next_].arrives <= now_; ++next_)
        assignment_.add(errands_[next_]);
      if (now_ % arguments_.every == 0) decide();
      step();
    }
    return report_;
  }

 private:
  void decide() {
    Given given = assignment_.give(session_.instance());
    return_excess(given, at_once_);
    if (given.empty()) return;
    const auto start = Clock::now();
    add_tasks(given);
    const double left = std::max(0.0, arguments_.think_s - seconds_since(start));
    const bool is_planned = session_.replan({.omega = kOmega, .time_limit = left}).plan.has_value();
    if (!is_planned) drop_tasks(given);
    // Adapts the number of new errands per decision to the number that can be planned in time.
    at_once_ =
        is_planned ? at_once_ + at_once_ / 4 + 1 : std::max<std::size_t>(1, given.size() / 2);
    at_once_ = std::min<std::size_t>(at_once_, static_cast<std::size_t>(arguments_.robots));
    ++report_.decisions;
    report_.seconds.push_back(seconds_since(start));
  }

  void add_tasks(const Given& given) {
    grove::Change change;
    for (const auto& [robot, errand] : given) {
      const std::string id = std::to_string(errand.id);
      change.new_tasks.push_back({.id = id, .place = errand.cell, .agents = {robot}});
      arrived_[id] = errand.arrives;
    }
    session_.change(change);
  }

  // Keeps the first `kept` assignments and returns the other errands to the open errands.
  void return_excess(Given& given, std::size_t kept) {
    for (std::size_t i = kept; i < given.size(); ++i) assignment_.add(given[i].second);
    given.resize(std::min(kept, given.size()));
  }

  // Removes the new errands after no plan was found in time, so that the robots continue without
  // them. The errands become open again.
  void drop_tasks(const Given& given) {
    ++report_.without_plan;
    grove::Change change;
    for (const auto& [robot, errand] : given) {
      change.dropped_tasks.push_back(std::to_string(errand.id));
      arrived_.erase(std::to_string(errand.id));
      assignment_.add(errand);
    }
    session_.change(change);
    const grove::Options any{.omega = std::numeric_limits<double>::infinity(),
                             .time_limit = kPatientSeconds};
    if (!session_.replan(any).plan)
      throw std::runtime_error("no plan within a minute, although there was one before");
  }

  // Advances all robots by one time step, and counts the tasks that leave the instance in this step
  // as done.
  void step() {
    session_.advance(1);
    const grove::Instance left = session_.instance();
    std::set<std::string> open;
    for (const grove::Task& task : left.tasks()) open.insert(task.id);
    std::erase_if(arrived_, [&](const auto& errand) {
      if (open.contains(errand.first)) return false;
      ++report_.done;
      report_.done_by_the_end_of_arrivals += now_ + 1 <= arguments_.steps ? 1 : 0;
      report_.waited += now_ + 1 - errand.second;
      report_.last = now_ + 1;
      return true;
    });
  }

  const Arguments arguments_;
  const std::vector<Errand> errands_;
  std::size_t next_ = 0;
  Assignment assignment_;
  std::size_t at_once_ = 1'000'000;  // maximum number of new errands per decision
  grove::Session session_;
  int now_ = 0;
  std::map<std::string, int> arrived_;  // by id of a task: arrival time of its errand
  Report report_;
};

void print(const Arguments& arguments, Report report) {
  std::ranges::sort(report.seconds);
  const auto at = [&](double part) {
    if (report.seconds.empty()) return 0.0;
    const double last = static_cast<double>(report.seconds.size() - 1);
    return 1000 * report.seconds[static_cast<std::size_t>(part * last)];
  };
  std::printf("%d of %d errands done, %d of them within %d steps, the last at %d\n", report.done,
              arguments.tasks, report.done_by_the_end_of_arrivals, arguments.steps, report.last);
  std::printf("from arrival to visit: %.1f steps on average\n",
              static_cast<double>(report.waited) / std::max(1, report.done));
  std::printf("%d decisions, %d without a plan in time; median %.1f ms, 95 %% %.1f, worst %.1f\n",
              report.decisions, report.without_plan, at(0.5), at(0.95), at(1));
}

grove::World read_grid(const std::string& map) {
  grove::World world = grove::World::read(map);
  if (!world.is_grid()) throw BadUsage(map + ": is a roadmap; expected a Moving AI map");
  return world;
}

int run(const std::vector<std::string>& words) try {
  if (std::ranges::find(words, "--help") != words.end()) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  const Arguments arguments = parse_arguments(words);
  print(arguments, Loop(read_grid(arguments.map), arguments).run());
  return 0;
} catch (const BadUsage& error) {
  std::fprintf(stderr, "grove-lifelong: error: %s (see 'grove-lifelong --help')\n", error.what());
  return 2;
} catch (const grove::InputError& error) {
  std::fprintf(stderr, "grove-lifelong: error: %s\n", error.what());
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "grove-lifelong: error: %s\n", error.what());
  return 1;
}

}  // namespace
}  // namespace lifelong

int main(int argc, char** argv) {
  return lifelong::run({argv + 1, argv + argc});
}
