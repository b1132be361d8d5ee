// SPDX-License-Identifier: MIT
#include "tests/mpi/random_schedule.h"

#include <deque>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "grove/engine/worker.h"
#include "mpi/member.h"
#include "mpi/simulated_network.h"

namespace grove::testing {
namespace {

constexpr double kTick = 1e-4;  // about what a step may take

using Dice = std::mt19937_64;

bool chance(Dice& dice, int percent) {
  return static_cast<int>(dice() % 100) < percent;
}

// A worker whose turns other things may come between.
struct SlowWorker : Worker {
  using Worker::Worker;
  std::optional<Worker::Turn> turn;
  bool performed = false;

  void step() {
    if (!turn) {
      turn = choose();
      performed = false;
    } else if (!performed) {
      perform(*turn);
      performed = true;
    } else {
      commit(*turn);
      turn.reset();
    }
  }
};

struct Process {
  Process(const Problem& problem, const SolveOptions& options, RunObserver& observer,
          Transport& transport, int workers_wanted)
      : member(problem, options, limits, observer, transport) {
    for (int i = 0; i < workers_wanted; ++i)
      workers.push_back(std::make_unique<SlowWorker>(problem, options, limits,
                                                     member.rank().search(), member.rank().stops(),
                                                     transport.rank() * workers_wanted + i));
  }

  // One thing that this process can do.
  void step(Dice& dice, double now) {
    if (said_farewell || chance(dice, 30)) {
      member.converse(now);
      return;
    }
    SlowWorker& worker = *workers[dice() % workers.size()];
    if (!member.rank().ended() || worker.turn)
      worker.step();
    else
      say_farewell();
  }

  void say_farewell() {
    Stats stats;
    for (const auto& worker : workers) {
      if (worker->turn) return;
      worker->add_counts(stats);
    }
    member.rank().farewell(stats);
    said_farewell = true;
  }

  Limits limits;
  Member member;
  std::vector<std::unique_ptr<SlowWorker>> workers;
  bool said_farewell = false;
  std::int64_t frozen_until = 0;
};

SimulatedNetwork::Delay random_delays(Dice& dice) {
  const double typical = std::vector<double>{0, 1, 10, 100}[dice() % 4] * kTick;
  return [&dice, typical](int, int, std::size_t) {
    const double most = chance(dice, 10) ? 20 * typical : typical;
    return std::uniform_real_distribution<double>(0, most + kTick)(dice);
  };
}

}  // namespace

Solution solve_in_random_order(const Instance& instance, const SolveOptions& options,
                               const Schedule& schedule, RunObserver& observer,
                               const std::function<bool(Cost)>& look, ScheduleCounts& counts) {
  Dice dice(schedule.seed);
  SimulatedNetwork network(schedule.ranks, random_delays(dice));
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
  while (!all_left() && counts.steps < schedule.most_steps) {
    ++counts.steps;
    network.advance_to(network.now() + kTick);
    Process& process = processes[dice() % processes.size()];
    if (process.frozen_until > counts.steps) continue;
    if (dice() % 500 == 0) process.frozen_until = counts.steps + static_cast<int>(dice() % 1500);
    process.step(dice, network.now());
    if (look(coordinator.ledger().lower_bound())) break;
  }
  counts.ended = all_left();
  for (int rank = 0; rank < schedule.ranks; ++rank) counts.messages += network.at(rank).messages();
  return coordinator.conclude();
}

}  // namespace grove::testing
