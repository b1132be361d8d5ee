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
#include "grove/engine/multicore.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <chrono>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "tasks.h"

namespace grove {
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

// A worker of a deterministic run and its turns of a round.
struct Lane {
  Worker* worker;
  std::vector<Worker::Turn> turns;

  void perform() {
    for (Worker::Turn& turn : turns) worker->perform(turn);
  }
  void commit() {
    for (Worker::Turn& turn : turns) worker->commit(turn);
    turns.clear();
  }
};

// The turns of a round: some nodes for each lane, the best ones evenly spread, or one step of its
// primal search. More nodes would be a poorer choice, fewer would leave threads waiting for each
// other.
void choose_turns(std::vector<Lane>& lanes) {
  for (int round = 0; round < kMostTurnsInARound; ++round)
    for (Lane& lane : lanes) {
      if (lane.turns.size() != static_cast<std::size_t>(round)) continue;
      if (round > 0 && lane.turns.back().job != Worker::Turn::Job::kExpand) continue;
      if (auto turn = lane.worker->choose()) lane.turns.push_back(std::move(*turn));
    }
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
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  std::vector<Lane> lanes;
  for (const auto& worker : workers) lanes.push_back({worker.get(), {}});
  arena.execute([&] {
    Tasks tasks;
    while (!shared.over()) {
      choose_turns(lanes);
      for (Lane& lane : lanes)
        if (!lane.turns.empty()) tasks.run([&lane] { lane.perform(); });
      tasks.wait();
      for (Lane& lane : lanes)
        if (!lane.turns.empty()) tasks.run([&lane] { lane.worker->publish(); });
      tasks.wait();
      for (Lane& lane : lanes) lane.commit();
      between_turns();
    }
  });
}

}  // namespace grove
