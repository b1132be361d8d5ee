// SPDX-License-Identifier: MIT
#include "tests/mpi/random_schedule.h"

#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "engine/worker.h"
#include "mpi/rank_process.h"
#include "mpi/simulated_network.h"

namespace grove::detail::testing {
namespace {

constexpr double kTick = 1e-4;    // s, duration of a step
constexpr int kLongQuiet = 3000;  // steps per rank, longer than the delay of any status or new tree

using Rng = std::mt19937_64;

bool chance(Rng& random, int percent) {
  return static_cast<int>(random() % 100) < percent;
}

// A worker whose work items are split into three steps, so that other events can occur between
// them.
struct SlowWorker : Worker {
  using Worker::Worker;
  std::unique_ptr<WorkItem> item;
  bool performed = false;

  // Returns false if there is no work item.
  bool step() {
    if (!item) {
      item = choose();
      performed = false;
      return item != nullptr;
    } else if (!performed) {
      item->perform(workspace());
      performed = true;
    } else {
      item->publish();
      commit(*item);
      item.reset();
    }
    return true;
  }
};

// Random parameters of a schedule.
struct Disturbances {
  explicit Disturbances(Rng& random)
      : poll_percent(pick(random, {10, 30, 30, 60})),
        freeze_once_in(pick(random, {500, 500, 3000})),
        freeze_on_news(pick(random, {0, 0, 1, 5})),
        longest_freeze(pick(random, {300, 1500, 5000})) {}

  static int pick(Rng& random, const std::vector<int>& values) {
    return values[random() % values.size()];
  }

  int poll_percent;    // percentage of steps in which a process polls for messages
  int freeze_once_in;  // mean number of steps between freezes
  int freeze_on_news;  // probability of a freeze after a received message, in percent
  int longest_freeze;  // steps
};

struct Process {
  Process(const Problem& problem, const SolveOptions& options, RunObserver& observer,
          Transport& transport, int workers_wanted)
      : member(problem, options, limits, observer, transport) {
    for (int i = 0; i < workers_wanted; ++i)
      workers.push_back(std::make_unique<SlowWorker>(member.rank().components(),
                                                     transport.rank() * workers_wanted + i));
  }

  struct Done {
    bool received = false;
    bool worked = false;
  };

  // Performs a random step that this process can make.
  Done step(Rng& random, const Disturbances& disturbances, double now) {
    if (finished || chance(random, disturbances.poll_percent))
      return {member.exchange_messages(now), false};
    SlowWorker& worker = *workers[random() % workers.size()];
    if (!member.rank().ended() || worker.item) return {false, worker.step()};
    try_to_finish();
    return {false, true};
  }

  void try_to_finish() {
    Counters counters;
    for (const auto& worker : workers) {
      if (worker->item) return;
      worker->add_counts(counters);
    }
    member.rank().send_finished(counters);
    finished = true;
  }

  Limits limits;
  RankProcess member;
  std::vector<std::unique_ptr<SlowWorker>> workers;
  bool finished = false;
  std::int64_t frozen_until = 0;
};

// Returns a random delay for each link. A message between two ranks can be overtaken by later
// messages that both of them send to the coordinator.
SimulatedNetwork::DelayModel random_delays(Rng& random, int ranks) {
  const std::vector<double> paces{0, 1, 10, 100, 3000, 20'000};
  const double usual = paces[random() % 4];
  std::vector<double> typical;
  for (int link = 0; link < ranks * ranks; ++link)
    typical.push_back(kTick * (chance(random, 70) ? usual : paces[random() % paces.size()]));
  if (chance(random, 30))  // messages from rank 0 to one rank are slow
    typical[random() % static_cast<std::size_t>(ranks)] = kTick * 1000;
  return [&random, typical, ranks](int from, int to, std::size_t) {
    const double most = typical[static_cast<std::size_t>(from * ranks + to)];
    const double now_and_then = most < kTick * 1000 && chance(random, 10) ? 20 : 1;
    return std::uniform_real_distribution<double>(0, now_and_then * most + kTick)(random);
  };
}

}  // namespace

Solution solve_in_random_order(const Instance& instance, const SolveOptions& options,
                               const Schedule& schedule, RunObserver& observer,
                               const std::function<bool(Cost)>& look, ScheduleCounts& counts) {
  Rng random(schedule.seed);
  SimulatedNetwork network(schedule.ranks, random_delays(random, schedule.ranks));
  const Limits no_limits;
  const Problem problem(instance, no_limits);
  std::deque<Process> processes;
  for (int rank = 0; rank < schedule.ranks; ++rank)
    processes.emplace_back(problem, options, observer, network.at(rank), schedule.workers);
  Coordinator& coordinator = *processes.front().member.coordinator();
  const auto all_left = [&] {
    for (Process& process : processes)
      if (!process.member.left()) return false;
    return true;
  };
  const auto in_transit = [&] {
    for (int rank = 0; rank < schedule.ranks; ++rank)
      if (network.next_arrival(rank) < std::numeric_limits<double>::infinity()) return true;
    return false;
  };
  const auto any_frozen = [&] {
    for (const Process& process : processes)
      if (process.frozen_until > counts.steps) return true;
    return false;
  };
  const Disturbances disturbances(random);
  std::int64_t quiet = 0;  // steps
  std::int64_t turns = 0;  // steps of workers
  while (!all_left() && counts.steps < schedule.max_steps && turns < schedule.max_turns &&
         !counts.stuck) {
    ++counts.steps;
    network.advance_to(network.now() + kTick);
    Process& process = processes[random() % processes.size()];
    if (process.frozen_until > counts.steps) continue;
    const auto done = process.step(random, disturbances, network.now());
    const bool is_calm = counts.steps > schedule.max_steps / 4;  // otherwise few runs would finish
    if (!is_calm &&
        (static_cast<int>(random() % static_cast<unsigned>(disturbances.freeze_once_in)) == 0 ||
         (done.received && chance(random, disturbances.freeze_on_news))))
      process.frozen_until =
          counts.steps +
          static_cast<int>(random() % static_cast<unsigned>(disturbances.longest_freeze));
    if (static_cast<int>(random() % 100'000) < schedule.limit_rate) {
      process.limits.stop(chance(random, 50) ? StopReason::kTime : StopReason::kInterrupt);
      counts.limit_reached = true;
    }
    turns += done.worked;
    if (look(coordinator.lower_bound())) break;
    quiet = done.received || done.worked || in_transit() || any_frozen() ? 0 : quiet + 1;
    counts.stuck = quiet > kLongQuiet * schedule.ranks;
  }
  counts.ended = all_left();
  counts.left_messages = counts.ended && in_transit();
  for (int rank = 0; rank < schedule.ranks; ++rank) counts.messages += network.at(rank).messages();
  return coordinator.conclude();
}

}  // namespace grove::detail::testing
