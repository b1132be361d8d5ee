// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tests/fuzz/random.h"
#include "tests/fuzz/random_instance.h"

namespace grove::detail::fuzz {
namespace {

// Approximate limit on the joint states of an instance, so that the oracle stays fast.
constexpr double kMaxJointStates = 4e6;

Heading random_heading(Random& random) {
  return static_cast<Heading>(random.below(4));
}

class Decorator {
 public:
  explicit Decorator(std::uint64_t seed)
      : random_(seed ^ 0x3D0E1D),
        instance_(random_.percent(40) ? random_roads(seed) : random_instance(seed)) {}
  Decorator(TinyInstance instance, std::uint64_t seed)
      : random_(seed ^ 0x3D0E1D), instance_(std::move(instance)), must_fit_(false) {}

  TinyInstance make() {
    if (instance_.roads.empty() && random_.percent(70)) turn();
    if (random_.percent(60)) work();
    if (random_.percent(30)) share_cells();
    if (random_.percent(30)) idle();
    if (must_fit_) make_fit();
    if (random_.percent(40)) begin_work();
    if (random_.percent(40)) start_on_roads();
    return instance_;
  }

 private:
  int agents() const { return static_cast<int>(instance_.agents.size()); }

  void turn() {
    const bool all = random_.percent(60);
    for (TinyInstance::Agent& agent : instance_.agents) {
      if (!all && random_.percent(50)) continue;
      agent.turn_steps = random_.pick<Time>({1, 1, 1, 2, 3});
      agent.heading = random_heading(random_);
      if (agent.turn_steps > 1 && random_.percent(30)) {
        agent.to = random_.percent(50) ? right_of(agent.heading) : left_of(agent.heading);
        agent.turned = random_.between(1, agent.turn_steps - 1);
      }
      if (agent.goal && random_.percent(30)) agent.goal_heading = random_heading(random_);
    }
  }

  // Gives some tasks a duration and adds such tasks on some destinations, where the finish is then
  // later than the arrival.
  void work() {
    for (TinyInstance::Task& task : instance_.tasks)
      if (random_.percent(60)) task.duration = random_.between(1, 4);
    for (int a = 0; a < agents(); ++a)
      if (const auto goal = instance_.agents[a].goal; goal && random_.percent(15))
        instance_.tasks.push_back({*goal, {a}, random_.between(1, 3)});
  }

  void share_cells() {
    for (int more = std::min<int>(2, static_cast<int>(instance_.tasks.size())); more > 0; --more) {
      TinyInstance::Task task = random_.pick(instance_.tasks);
      task.duration = random_.percent(50) ? 0 : random_.between(1, 3);
      instance_.tasks.push_back(task);
    }
  }

  void idle() {
    const int agent = random_.below(agents());
    instance_.agents[agent].goal.reset();
    instance_.agents[agent].goal_heading.reset();
    for (TinyInstance::Task& task : instance_.tasks) std::erase(task.agents, agent);
    std::erase_if(instance_.tasks, [](const auto& task) { return task.agents.empty(); });
  }

  double states(int a) const {
    double places = static_cast<double>(passable_cells(instance_.rows).size());
    for (const TinyInstance::Road& road : instance_.roads) places += road.steps - 1;
    const Time turn = instance_.agents[a].turn_steps;
    const double poses = turn == 0 ? 1 : 4 + 8 * (turn - 1);
    double sets = 1;
    double at_work = 0;
    for (const TinyInstance::Task& task : instance_.tasks) {
      if (std::ranges::count(task.agents, a) == 0) continue;
      sets *= 2;
      at_work += task.duration * poses;
    }
    return 2 * sets * (places * poses + at_work);
  }

  void make_fit() {
    const auto joint = [&] {
      double product = 1;
      for (int a = 0; a < agents(); ++a) product *= states(a);
      return product;
    };
    while (joint() > kMaxJointStates && instance_.tasks.size() > 1) drop_task();
    while (joint() > kMaxJointStates && agents() > 1) drop_last_agent();
  }

  void drop_task() {
    instance_.tasks.erase(instance_.tasks.begin() +
                          random_.below(static_cast<int>(instance_.tasks.size())));
  }
  void drop_last_agent() {
    instance_.agents.pop_back();
    for (TinyInstance::Task& task : instance_.tasks) std::erase(task.agents, agents());
    std::erase_if(instance_.tasks, [](const auto& task) { return task.agents.empty(); });
  }

  // Lets some agents start while they execute one of their tasks. Moves the task to the start if
  // necessary.
  void begin_work() {
    for (int a = 0; a < agents(); ++a) {
      TinyInstance::Agent& agent = instance_.agents[a];
      if (!random_.percent(50)) continue;
      for (std::size_t t = 0; t < instance_.tasks.size(); ++t) {
        TinyInstance::Task& task = instance_.tasks[t];
        if (std::ranges::count(task.agents, a) == 0 || task.duration == 0) continue;
        const bool begun = std::ranges::count(instance_.agents, static_cast<int>(t),
                                              &TinyInstance::Agent::work) > 0;
        if (!begun && random_.percent(40)) task.cell = agent.start;
        if (task.cell != agent.start) continue;
        agent.work = static_cast<int>(t);
        agent.done = random_.below(task.duration);
        break;
      }
    }
  }

  void start_on_roads() {
    for (TinyInstance::Agent& agent : instance_.agents) {
      if (instance_.roads.empty() || agent.work >= 0 || !random_.percent(40)) continue;
      const int road = random_.below(static_cast<int>(instance_.roads.size()));
      if (instance_.roads[road].steps == 1) continue;
      const bool taken = std::ranges::any_of(
          instance_.agents, [&](const TinyInstance::Agent& a) { return a.road == road; });
      if (taken) continue;
      agent.road = road;
      agent.along = random_.between(1, instance_.roads[road].steps - 1);
    }
  }

  Random random_;
  TinyInstance instance_;
  bool must_fit_ = true;
};

}  // namespace

TinyInstance random_world(std::uint64_t seed) {
  return Decorator(seed).make();
}

TinyInstance with_motions(TinyInstance instance, std::uint64_t seed) {
  return Decorator(std::move(instance), seed).make();
}

TinyInstance any_instance(std::uint64_t seed) {
  return seed % 2 == 0 ? random_instance(seed) : random_world(seed);
}

}  // namespace grove::detail::fuzz
