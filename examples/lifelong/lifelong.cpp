// SPDX-License-Identifier: MIT
// grove-lifelong: a control loop around a Session. Errands arrive continuously. At each decision
// the loop adds open errands to the session, as tasks of any robot or of the nearest robot without
// a task, and re-plans.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <grove/grove.hpp>
#include <limits>
#include <map>
#include <numeric>
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
constexpr int kTasksPerRobot = 10;  // that the session has at most, if robots share them
constexpr int kMostWeight = 100;    // of --visit-weight
constexpr int kMost = 1'000'000;    // of other options
constexpr int kMoreSteps = 10'000;  // after the last arrival, before the loop stops waiting

constexpr const char* kUsage =
    R"(usage: grove-lifelong MAP [--OPTION VALUE]...

Assigns errands to robots as they arrive, on a Moving AI map.

  --robots N      robots (default: 200)
  --tasks N       errands that arrive (default: 1000)
  --steps N       steps over which they arrive (default: 2000)
  --every N       steps between decisions (default: 1)
  --think S       seconds for each decision (default: 0.1)
  --turn-steps N  steps of a quarter turn; 0: robots turn freely (default: 0)
  --seed N        seed of errands and starts (default: 0)
  --assign RULE   any: each errand is a task that any robot may do, and Grove chooses the robot
                  again at each decision; nearest: the errand is for the nearest robot without a
                  task (default: any)
  --visit-weight N  with any: weight of early visits against few steps, 0 to 100 (default: 10)
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
  bool any_robot = true;
  int visit_weight = 10;
};

double number(const std::string& option, const std::string& text, double least, double most) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most))
    throw BadUsage(option + ": found '" + text + "'; expected a number from " +
                   std::to_string(static_cast<int>(least)) + " to " +
                   std::to_string(static_cast<int>(most)));
  return value;
}

int integer(const std::string& option, const std::string& text, int least, int most) {
  const double value = number(option, text, least, most);
  if (value != static_cast<int>(value)) throw BadUsage(option + ": expected a whole number");
  return static_cast<int>(value);
}

bool is_any(const std::string& rule) {
  if (rule != "any" && rule != "nearest")
    throw BadUsage("--assign: found '" + rule + "'; expected any or nearest");
  return rule == "any";
}

Arguments parse_arguments(const std::vector<std::string>& words) {
  Arguments arguments;
  struct Integer {
    int* value;
    int least;
    int most = kMost;
  };
  const std::map<std::string, Integer> integers{
      {"--robots", {&arguments.robots, 1}},
      {"--tasks", {&arguments.tasks, 1}},
      {"--steps", {&arguments.steps, 1}},
      {"--every", {&arguments.every, 1}},
      {"--seed", {&arguments.seed, 0}},
      {"--turn-steps", {&arguments.turn_steps, 0}},
      {"--visit-weight", {&arguments.visit_weight, 0, kMostWeight}}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("--")) {
      if (!arguments.map.empty()) throw BadUsage("found two maps; expected one");
      arguments.map = words[i];
      continue;
    }
    const std::string& option = words[i];
    const auto found = integers.find(option);
    if (found == integers.end() && option != "--think" && option != "--assign")
      throw BadUsage(option + ": no such option");
    if (++i == words.size()) throw BadUsage(option + ": expected a value after it");
    if (option == "--assign")
      arguments.any_robot = is_any(words[i]);
    else if (found == integers.end())
      arguments.think_s = number(option, words[i], 0, 1e6);
    else
      *found->second.value = integer(option, words[i], found->second.least, found->second.most);
  }
  if (arguments.map.empty()) throw BadUsage("expected a MAP");
  return arguments;
}

struct Report {
  int done = 0;
  int done_by_the_end_of_arrivals = 0;
  std::vector<int> waits;  // of each done errand: the steps from arrival to visit
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
  if (std::ssize(robots) < arguments.robots)
    throw BadUsage("--robots: found " + std::to_string(arguments.robots) + "; expected at most " +
                   std::to_string(robots.size()) + ", the number of passable cells");
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
    for (now_ = 0; report_.done < arguments_.tasks && now_ < arguments_.steps + kMoreSteps;
         ++now_) {
      for (; next_ < errands_.size() && errands_[next_].arrives <= now_; ++next_)
        assignment_.add(errands_[next_]);
      if (now_ % arguments_.every == 0) decide();
      step();
    }
    return report_;
  }

 private:
  void decide() {
    Given given = give();
    return_excess(given, at_once_);
    if (given.empty()) return;
    const auto start = Clock::now();
    add_tasks(given);
    const double left = std::max(0.0, arguments_.think_s - seconds_since(start));
    const grove::Options options{
        .omega = kOmega, .time_limit = left, .visit_weight = arguments_.visit_weight};
    const bool is_planned = session_.replan(options).plan.has_value();
    if (!is_planned) drop_tasks(given);
    // Adapts the number of new errands per decision to the number that can be planned in time.
    at_once_ =
        is_planned ? at_once_ + at_once_ / 4 + 1 : std::max<std::size_t>(1, given.size() / 2);
    at_once_ = std::min<std::size_t>(at_once_, static_cast<std::size_t>(arguments_.robots));
    ++report_.decisions;
    report_.seconds.push_back(seconds_since(start));
  }

  Given give() {
    if (!arguments_.any_robot) return assignment_.give_to_nearest(session_.instance());
    return assignment_.give_to_any(session_.instance(),
                                   static_cast<std::size_t>(kTasksPerRobot * arguments_.robots));
  }

  void add_tasks(const Given& given) {
    grove::Change change;
    for (const auto& [robot, errand] : given) {
      const std::string id = std::to_string(errand.id);
      grove::Task task{.id = id, .place = errand.cell, .need = 1};
      if (robot.empty())
        task.all_agents = true;
      else
        task.agents = {robot};
      change.new_tasks.push_back(std::move(task));
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
      report_.waits.push_back(now_ + 1 - errand.second);
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

// Returns the value below which `part` of the values are; 0 without values.
double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

void print(const Arguments& arguments, const Report& report) {
  const std::vector<double> waits(report.waits.begin(), report.waits.end());
  const double sum = std::accumulate(waits.begin(), waits.end(), 0.0);
  const auto ms = [&](double part) { return 1000 * quantile(report.seconds, part); };
  std::printf("%d of %d errands done, %d of them within %d steps, the last at %d\n", report.done,
              arguments.tasks, report.done_by_the_end_of_arrivals, arguments.steps, report.last);
  std::printf("from arrival to visit: %.1f steps on average, median %.0f, 95 %% %.0f\n",
              sum / std::max(1, report.done), quantile(waits, 0.5), quantile(waits, 0.95));
  std::printf("%d decisions, %d without a plan in time; median %.1f ms, 95 %% %.1f, worst %.1f\n",
              report.decisions, report.without_plan, ms(0.5), ms(0.95), ms(1));
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
