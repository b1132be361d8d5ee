// SPDX-License-Identifier: MIT
// A worker has a thread and takes turns until there is nothing to do. Then it parks, and a worker
// that brings work back wakes it.
//
// No work is overlooked: a worker parks under the lock under which it saw that no node was open,
// and a node is pushed before that lock is taken to look for parked workers. So either the parking
// worker sees the node or the pushing one sees the worker. No worker parks while no node is live:
// then the next tree is due, or the run is over, and a worker must find out. Nor does the last one
// that is awake: where ranks share a search, nodes come from elsewhere, and no thread that pushes
// them wakes a worker; and a live node may be in no worker's hands here, because it is in custody.
#include "engine/multicore.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "model/thread_team.h"

namespace grove::detail {
namespace {

constexpr int kMostTurnsInARound = 4;
constexpr auto kPause = std::chrono::microseconds(100);  // of one who may not park

class WorkerPool {
 public:
  WorkerPool(SharedSearch& shared, const Limits& limits, const BetweenItems& between_turns)
      : shared_(shared), limits_(limits), between_turns_(between_turns) {}

  void work(Worker& worker) {
    begin();
    try {
      for (; !shared_.over(); between_turns_())
        if (worker.turn())
          call_another();
        else if (!park())
          std::this_thread::sleep_for(kPause);
    } catch (const std::bad_alloc&) {
      limits_.memory_exhausted();
    } catch (...) {
      end();
      throw;
    }
    end();
  }

 private:
  void begin() {
    const std::lock_guard lock(mutex_);
    ++awake_;
  }

  void end() {
    limits_.cancel_workers();
    {
      const std::lock_guard lock(mutex_);
      --awake_;
      ended_ = true;
    }
    called_.notify_all();
  }

  // Waits until another worker calls, or the run has ended. False: this one must not wait.
  bool park() {
    std::unique_lock lock(mutex_);
    if (awake_ == 1 || ended_ || shared_.over() || shared_.may_take()) return false;
    --awake_;
    ++parked_;
    called_.wait(lock, [this] { return ended_ || calls_ > 0; });
    if (calls_ > 0)
      --calls_;
    else
      --parked_;
    ++awake_;
    return true;
  }

  // Wakes a parked worker if there is work for it.
  void call_another() {
    {
      const std::lock_guard lock(mutex_);
      if (parked_ == 0 || !shared_.may_take()) return;
      --parked_;
      ++calls_;
    }
    called_.notify_one();
  }

  SharedSearch& shared_;
  const Limits& limits_;
  const BetweenItems& between_turns_;
  std::mutex mutex_;  // guards all below
  std::condition_variable called_;
  int awake_ = 0;
  int parked_ = 0;  // and not called
  int calls_ = 0;   // of workers that have not woken yet
  bool ended_ = false;
};

// Of a deterministic run: what a worker does in a round.
struct Unit {
  Worker* worker;
  Worker::WorkItem turn;

  bool is_primal() const { return turn.job == Worker::WorkItem::Job::kPrimal; }
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
      goes_on[w] = turn && turn->job == Worker::WorkItem::Job::kExpand;
      if (turn) units.push_back({workers[w].get(), std::move(*turn)});
    }
  // They take longest.
  std::stable_partition(units.begin(), units.end(), [](const Unit& u) { return u.is_primal(); });
  return units;
}

// Calls `what` with each unit, and waits for all. A worker's units are done in order, by one
// thread: what its expander has cached, and so the number of labels that it expands, must not
// depend on the threads.
template <class What>
void for_each_unit(std::vector<Unit>& units, ThreadTeam& team, const What& what) {
  std::vector<Worker*> workers;
  for (const Unit& unit : units)
    if (std::ranges::find(workers, unit.worker) == workers.end()) workers.push_back(unit.worker);
  std::atomic<std::size_t> next{0};
  team.run([&](int) {
    for (std::size_t w = next++; w < workers.size(); w = next++)
      for (Unit& unit : units)
        if (unit.worker == workers[w]) what(unit);
  });
}

}  // namespace

void run_single_threaded(Worker& worker, const SharedSearch& shared,
                         const BetweenItems& between_turns) {
  for (; !shared.over(); between_turns()) worker.turn();
}

void run_parallel(std::span<const std::unique_ptr<Worker>> workers, SharedSearch& shared,
                  const Limits& limits, const BetweenItems& between_turns) {
  struct AllowWork {
    const Limits& limits;
    ~AllowWork() { limits.clear_cancel(); }
  } const at_last{limits};
  WorkerPool crew(shared, limits, between_turns);
  ThreadTeam(static_cast<int>(workers.size())).run([&](int thread) {
    crew.work(*workers[static_cast<std::size_t>(thread)]);
  });
}

void run_deterministic(std::span<const std::unique_ptr<Worker>> workers, SharedSearch& shared,
                       int threads, const BetweenItems& between_turns) {
  ThreadTeam team(std::min(threads, static_cast<int>(workers.size())));
  const auto perform = [](Unit& unit) { unit.worker->perform(unit.turn, unit.worker->expander()); };
  const auto publish = [](Unit& unit) { Worker::publish(unit.turn); };
  while (!shared.over()) {
    std::vector<Unit> units = choose_round(workers);
    for_each_unit(units, team, perform);
    for_each_unit(units, team, publish);
    for (Unit& unit : units) unit.worker->commit(unit.turn);
    between_turns();
  }
}

}  // namespace grove::detail
