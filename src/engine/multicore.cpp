// SPDX-License-Identifier: MIT
// A worker is a TBB task that takes turns until there is nothing to do. Then it ends, for a task
// that waits holds up a thread; whoever brings work back starts it again.
//
// No work is overlooked: a worker parks under the lock under which it saw that no node was open,
// and a node is pushed before that lock is taken to look for who is parked. So either the parking
// worker sees the node or the pushing one sees the worker. And nobody parks while no node is live:
// then the next tree is due, or the run is over, and somebody must find out. Nor does the last one
// who is awake: where ranks share a search, nodes come from elsewhere, and none of those who push
// them there calls anybody; and a node may be live that nobody here has in hand, for it is in
// custody.
#include "grove/detail/engine/multicore.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "tasks.h"

namespace grove::detail {
namespace {

constexpr int kMostTurnsInARound = 4;
constexpr auto kPause = std::chrono::microseconds(100);  // of one who may not park

class Crew {
 public:
  Crew(SharedSearch& shared, const Limits& limits, const BetweenTurns& between_turns)
      : shared_(shared), limits_(limits), between_turns_(between_turns) {}

  void run(std::span<const std::unique_ptr<Worker>> workers) {
    workers_ = workers.size();
    for (const auto& worker : workers) start(*worker);
    tasks_.wait();
  }

 private:
  void start(Worker& worker) {
    tasks_.run([this, &worker] { work(worker); });
  }

  void work(Worker& worker) {
    try {
      for (; !shared_.over(); between_turns_())
        if (worker.turn())
          call_another();
        else if (park(worker))
          return;
        else
          std::this_thread::sleep_for(kPause);
    } catch (const std::bad_alloc&) {
      limits_.memory_exhausted();
    } catch (...) {
      limits_.end_work();
      throw;
    }
    limits_.end_work();
  }

  bool park(Worker& worker) {
    const std::lock_guard lock(mutex_);
    const bool is_last_awake = parked_.size() + 1 == workers_;
    if (is_last_awake || shared_.over() || shared_.may_take()) return false;
    parked_.push_back(&worker);
    return true;
  }

  // Starts a parked worker if there is work for it.
  void call_another() {
    const std::lock_guard lock(mutex_);
    if (parked_.empty() || !shared_.may_take()) return;
    start(*parked_.back());
    parked_.pop_back();
  }

  SharedSearch& shared_;
  const Limits& limits_;
  const BetweenTurns& between_turns_;
  Tasks tasks_;
  std::size_t workers_ = 0;
  std::mutex mutex_;
  std::vector<Worker*> parked_;
};

// Of a deterministic run: what a worker does in a round.
struct Unit {
  Worker* worker;
  Worker::Turn turn;

  bool is_primal() const { return turn.job == Worker::Turn::Job::kPrimal; }
};

// Some nodes for each worker, or one step of its primal search. More nodes would be a poorer
// choice, fewer would leave threads waiting for each other.
std::vector<Unit> choose_round(std::span<const std::unique_ptr<Worker>> workers) {
  std::vector<Unit> units;
  std::vector<bool> goes_on(workers.size(), true);
  for (int i = 0; i < kMostTurnsInARound; ++i)
    for (std::size_t w = 0; w < workers.size(); ++w) {
      if (!goes_on[w]) continue;
      auto turn = workers[w]->choose();
      goes_on[w] = turn && turn->job == Worker::Turn::Job::kExpand;
      if (turn) units.push_back({workers[w].get(), std::move(*turn)});
    }
  // They take longest. Who performs them is one and the same for all that matters.
  std::stable_partition(units.begin(), units.end(), [](const Unit& u) { return u.is_primal(); });
  return units;
}

// Calls `what` with each unit, on as many threads as the arena has, and waits for all.
template <class What>
void for_each_unit(std::vector<Unit>& units, int threads, Tasks& tasks, const What& what) {
  std::atomic<std::size_t> next{0};
  for (int i = 0; i < threads; ++i)
    tasks.run([&] {
      for (std::size_t u = next++; u < units.size(); u = next++) what(units[u]);
    });
  tasks.wait();
}

}  // namespace

void solve_alone(Worker& worker, const SharedSearch& shared, const BetweenTurns& between_turns) {
  for (; !shared.over(); between_turns()) worker.turn();
}

void solve_together(std::span<const std::unique_ptr<Worker>> workers, SharedSearch& shared,
                    const Limits& limits, const BetweenTurns& between_turns) {
  const auto threads = static_cast<int>(workers.size());
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  struct AllowWork {
    const Limits& limits;
    ~AllowWork() { limits.allow_work(); }
  } const at_last{limits};
  tbb::task_arena arena(threads);
  arena.execute([&] { Crew(shared, limits, between_turns).run(workers); });
}

void solve_in_rounds(std::span<const std::unique_ptr<Worker>> workers, SharedSearch& shared,
                     int threads, const BetweenTurns& between_turns) {
  threads = std::min(threads, static_cast<int>(workers.size()));
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  // More expanders than threads would compete for the cache.
  const auto perform = [&](Unit& unit) {
    const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
    unit.worker->perform(unit.turn, workers[thread]->expander());
  };
  const auto publish = [](Unit& unit) { Worker::publish(unit.turn); };
  arena.execute([&] {
    Tasks tasks;
    while (!shared.over()) {
      std::vector<Unit> units = choose_round(workers);
      for_each_unit(units, threads, tasks, perform);
      for_each_unit(units, threads, tasks, publish);
      for (Unit& unit : units) unit.worker->commit(unit.turn);
      between_turns();
    }
  });
}

}  // namespace grove::detail
