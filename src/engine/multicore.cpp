// SPDX-License-Identifier: MIT
// Each worker has a thread and performs work items until none is available; then it parks. A worker
// that completes an item wakes a parked worker if there is work for it.
//
// Claim: whenever a worker here has pushed an open node, some worker that is not parked will find
// it. Proof: a worker tests that no node is open, and parks, under one lock. A worker pushes nodes
// before it takes this lock to look for parked workers. Hence either the parking worker sees the
// node, or the pushing worker sees the parked one.
//
// Even if no work item has become available in the meantime, a worker that found none does not park
// in two cases:
// - No node is live. Then either the next tree is due or the run is over, and a worker must
//   determine which of the two.
// - All other workers are parked. With several ranks, nodes arrive from other ranks, and the
//   communicating thread that pushes them wakes no worker. Moreover, the only live nodes can be in
//   custody, so that no worker here has one.
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

constexpr int kMaxTurnsPerRound = 4;
constexpr auto kPause = std::chrono::microseconds(100);  // sleep of a worker that must not park

class WorkerPool {
 public:
  WorkerPool(const Components& components, const Limits& limits, const BetweenItems& between_turns)
      : components_(components), limits_(limits), between_turns_(between_turns) {}

  void work(Worker& worker) {
    begin();
    try {
      for (; !components_.over(); between_turns_())
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

  bool may_find_work() const { return components_.has_work() || !components_.has_live_nodes(); }

  // Waits until another worker wakes this one or the run has ended. Returns false if this worker
  // must not wait.
  bool park() {
    std::unique_lock lock(mutex_);
    if (awake_ == 1 || ended_ || components_.over() || may_find_work()) return false;
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

  // Wakes a parked worker if a work item may be available for it.
  void call_another() {
    {
      const std::lock_guard lock(mutex_);
      if (parked_ == 0 || !may_find_work()) return;
      --parked_;
      ++calls_;
    }
    called_.notify_one();
  }

  const Components& components_;
  const Limits& limits_;
  const BetweenItems& between_turns_;
  std::mutex mutex_;  // guards all members below
  std::condition_variable called_;
  int awake_ = 0;
  int parked_ = 0;  // parked workers not yet called
  int calls_ = 0;   // called workers that have not woken yet
  bool ended_ = false;
};

// One work item of a round of a deterministic run.
struct Unit {
  Worker* worker;
  std::unique_ptr<WorkItem> item;
};

// Chooses the work items of a round: up to kMaxTurnsPerRound per worker. A worker gets no further
// item after one that does not allow it (WorkItem::allows_next()). With more items per round the
// choice of nodes would be worse. With fewer, threads would wait for each other more often.
std::vector<Unit> choose_round(std::span<const std::unique_ptr<Worker>> workers) {
  std::vector<Unit> units;
  std::vector<bool> continues(workers.size(), true);
  for (int i = 0; i < kMaxTurnsPerRound; ++i)
    for (std::size_t w = 0; w < workers.size(); ++w) {
      if (!continues[w]) continue;
      auto item = workers[w]->choose();
      continues[w] = item && item->allows_next();
      if (item) units.push_back({workers[w].get(), std::move(item)});
    }
  std::stable_partition(units.begin(), units.end(),
                        [](const Unit& u) { return u.item->is_long(); });
  return units;
}

// Calls `what` with each unit and waits for all calls. One thread handles all units of a worker, in
// order, so that the content of the expander's cache, and therefore the number of labels that it
// expands, does not depend on the number of threads.
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

void run_single_threaded(Worker& worker, const Components& components,
                         const BetweenItems& between_turns) {
  for (; !components.over(); between_turns()) worker.turn();
}

void run_parallel(std::span<const std::unique_ptr<Worker>> workers, const Components& components,
                  const Limits& limits, const BetweenItems& between_turns) {
  struct AllowWork {
    const Limits& limits;
    ~AllowWork() { limits.clear_cancel(); }
  } const at_last{limits};
  WorkerPool pool(components, limits, between_turns);
  ThreadTeam(static_cast<int>(workers.size())).run([&](int thread) {
    pool.work(*workers[static_cast<std::size_t>(thread)]);
  });
}

void run_deterministic(std::span<const std::unique_ptr<Worker>> workers,
                       const Components& components, int threads,
                       const BetweenItems& between_turns) {
  ThreadTeam team(std::min(threads, static_cast<int>(workers.size())));
  const auto perform = [](Unit& unit) { unit.item->perform(unit.worker->workspace()); };
  const auto publish = [](Unit& unit) { unit.item->publish(); };
  while (!components.over()) {
    std::vector<Unit> units = choose_round(workers);
    for_each_unit(units, team, perform);
    for_each_unit(units, team, publish);
    for (Unit& unit : units) unit.worker->commit(*unit.item);
    between_turns();
  }
}

}  // namespace grove::detail
