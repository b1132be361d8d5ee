// SPDX-License-Identifier: MIT
#include "mpi/simulator/simulated_worker.h"

#include <ctime>

namespace grove::detail {

MddCache::Set MddInterner::one_of(const MddCache::Set& set) {
  const std::uint64_t hash = set->hash();
  const auto [first, end] = mdds_.equal_range(hash);
  for (auto at = first; at != end; ++at)
    if (auto other = at->second.lock(); other && *other == *set) return other;
  if (mdds_.size() >= cleanup_size_) forget_unused();
  mdds_.emplace(hash, set);
  return set;
}

void MddInterner::forget_unused() {
  std::erase_if(mdds_, [](const auto& entry) { return entry.second.expired(); });
  cleanup_size_ = 2 * mdds_.size() + 1000;
}

void SimulatedWorker::begin(double now, Expander& expander) {
  turn_ = worker_.choose();
  if (!turn_) return;
  const double before = expander.whole_work();
  const double before_s = processor_time();
  expander.swap_cache(agent_caches_);
  worker_.perform(*turn_, expander);
  expander.swap_cache(agent_caches_);
  for (auto& [id, mdd] : turn_->found.mdds)
    if (mdd.use_count() == 1) mdd = mdds_.one_of(mdd);  // just built by this item
  // Publishing here, before the simulated end of the item, is not too early: a simulated rank has
  // only one worker, so no other worker of the rank can read the results.
  Worker::publish(*turn_);
  const double processor_s = processor_time() - before_s;
  const double work = expander.whole_work() - before + static_cast<double>(turn_->lagrangian.work);
  const double takes_s =
      machine_.seconds_per_work > 0 ? work * machine_.seconds_per_work : processor_s;
  began_ = now;
  busy_until_ = now + takes_s;
  if (tally_.turns == 0) tally_.first_turn_s = now;
  ++tally_.turns;
  tally_.work += work;
  tally_.busy_s += takes_s;
  tally_.processor_s += processor_s;
}

void SimulatedWorker::end() {
  worker_.commit(*turn_);
  turn_.reset();
}

void SimulatedWorker::abandon(double now) {
  tally_.busy_s -= busy_until_ - now;
  busy_until_ = now;
  turn_->expansion = {};
  turn_->expansion.stopped = true;
  end();
}

double processor_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace grove::detail
