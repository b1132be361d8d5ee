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

namespace {

// Lets a work item use an expander that serves all workers.
class SharedExpander : public Workspace {
 public:
  explicit SharedExpander(Expander& expander) : expander_(expander) {}
  Expander& expander() override { return expander_; }

 private:
  Expander& expander_;
};

}  // namespace

void SimulatedWorker::begin(double now, Expander& expander) {
  item_ = worker_.choose();
  if (!item_) return;
  const double before_s = processor_time();
  expander.swap_cache(agent_caches_);
  SharedExpander workspace(expander);
  item_->perform(workspace);
  expander.swap_cache(agent_caches_);
  if (CacheDelta* const found = item_->new_results())
    for (auto& [id, mdd] : found->mdds)
      if (mdd.use_count() == 1) mdd = mdds_.one_of(mdd);  // just built by this item
  // Publishing here, before the simulated end of the item, is not too early: a simulated rank has
  // only one worker, so no other worker of the rank can read the results.
  item_->publish();
  const double processor_s = processor_time() - before_s;
  const double work = item_->duration();
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
  worker_.commit(*item_);
  item_.reset();
}

void SimulatedWorker::abandon(double now) {
  tally_.busy_s -= busy_until_ - now;
  busy_until_ = now;
  item_->abandon();
  end();
}

double processor_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace grove::detail
