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

constexpr double kTick = 1e-4;    // about what a step may take
constexpr int kLongQuiet = 3000;  // steps of a rank; statuses wait for fewer, trees without nodes

using Dice = std::mt19937_64;

bool chance(Dice& dice, int percent) {
  return static_cast<int>(dice() % 100) < percent;
}

// A worker whose turns other things may come between.
struct SlowWorker : Worker {
  using Worker::Worker;
  std::optional<Worker::WorkItem> turn;
  bool performed = false;

  // False: there was nothing to do.
  bool step() {
    if (!turn) {
      turn = choose();
      performed = false;
      return turn.has_value();
    } else if (!performed) {
      perform(*turn, expander());
      performed = true;
    } else {
      publish(*turn);
      commit(*turn);
      turn.reset();
    }
    return true;
  }
};

// What kind of trouble a schedule is.
struct Temper {
  explicit Temper(Dice& dice)
      : talk(pick(dice, {10, 30, 30, 60})),
        freeze_once_in(pick(dice, {500, 500, 3000})),
        freeze_on_news(pick(dice, {0, 0, 1, 5})),
        longest_freeze(pick(dice, {300, 1500, 5000})) {}

  static int pick(Dice& dice, const std::vector<int>& values) {
    return values[dice() % values.size()];
  }

  int talk;            // percent of the steps
  int freeze_once_in;  // steps
  int freeze_on_news;  // percent
  int longest_freeze;  // steps
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

  struct Done {
    bool heard = false;
    bool worked = false;
  };

  // One thing that this process can do.
  Done step(Dice& dice, const Temper& temper, double now) {
    if (said_farewell || chance(dice, temper.talk)) return {member.exchange_messages(now), false};
    SlowWorker& worker = *workers[dice() % workers.size()];
    if (!member.rank().ended() || worker.turn) return {false, worker.step()};
    say_farewell();
    return {false, true};
  }

  void say_farewell() {
    Stats stats;
    for (const auto& worker : workers) {
      if (worker->turn) return;
      worker->add_counts(stats);
    }
    member.rank().send_finished(stats);
    said_farewell = true;
  }

  Limits limits;
  RankProcess member;
  std::vector<std::unique_ptr<SlowWorker>> workers;
  bool said_farewell = false;
  std::int64_t frozen_until = 0;
};

// Each link has a pace of its own: what one rank says to another may be overtaken for long by what
// both say to the coordinator.
SimulatedNetwork::DelayModel random_delays(Dice& dice, int ranks) {
  const std::vector<double> paces{0, 1, 10, 100, 3000, 20'000};
  const double usual = paces[dice() % 4];
  std::vector<double> typical;
  for (int link = 0; link < ranks * ranks; ++link)
    typical.push_back(kTick * (chance(dice, 70) ? usual : paces[dice() % paces.size()]));
  if (chance(dice, 30))  // one rank is the last to be told
    typical[dice() % static_cast<std::size_t>(ranks)] = kTick * 1000;
  return [&dice, typical, ranks](int from, int to, std::size_t) {
    const double most = typical[static_cast<std::size_t>(from * ranks + to)];
    const double now_and_then = most < kTick * 1000 && chance(dice, 10) ? 20 : 1;
    return std::uniform_real_distribution<double>(0, now_and_then * most + kTick)(dice);
  };
}

}  // namespace

Solution solve_in_random_order(const Instance& instance, const SolveOptions& options,
                               const Schedule& schedule, RunObserver& observer,
                               const std::function<bool(Cost)>& look, ScheduleCounts& counts) {
  Dice dice(schedule.seed);
  SimulatedNetwork network(schedule.ranks, random_delays(dice, schedule.ranks));
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
  const auto under_way = [&] {
    for (int rank = 0; rank < schedule.ranks; ++rank)
      if (network.next_arrival(rank) < std::numeric_limits<double>::infinity()) return true;
    return false;
  };
  const auto any_frozen = [&] {
    for (const Process& process : processes)
      if (process.frozen_until > counts.steps) return true;
    return false;
  };
  const Temper temper(dice);
  std::int64_t quiet = 0;  // steps
  std::int64_t turns = 0;  // parts of them
  while (!all_left() && counts.steps < schedule.most_steps && turns < schedule.most_turns &&
         !counts.stuck) {
    ++counts.steps;
    network.advance_to(network.now() + kTick);
    Process& process = processes[dice() % processes.size()];
    if (process.frozen_until > counts.steps) continue;
    const auto done = process.step(dice, temper, network.now());
    const bool is_calm = counts.steps > schedule.most_steps / 4;  // or few would come to their end
    if (!is_calm && (static_cast<int>(dice() % static_cast<unsigned>(temper.freeze_once_in)) == 0 ||
                     (done.heard && chance(dice, temper.freeze_on_news))))
      process.frozen_until =
          counts.steps + static_cast<int>(dice() % static_cast<unsigned>(temper.longest_freeze));
    if (static_cast<int>(dice() % 100'000) < schedule.strikes) {
      process.limits.stop(chance(dice, 50) ? StopReason::kTime : StopReason::kInterrupt);
      counts.struck = true;
    }
    turns += done.worked;
    if (look(coordinator.lower_bound())) break;
    quiet = done.heard || done.worked || under_way() || any_frozen() ? 0 : quiet + 1;
    counts.stuck = quiet > kLongQuiet * schedule.ranks;
  }
  counts.ended = all_left();
  counts.left_messages = counts.ended && under_way();
  for (int rank = 0; rank < schedule.ranks; ++rank) counts.messages += network.at(rank).messages();
  return coordinator.conclude();
}

}  // namespace grove::detail::testing
