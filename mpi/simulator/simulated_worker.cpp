// SPDX-License-Identifier: MIT
#include "mpi/simulator/simulated_worker.h"

#include <utility>

#include "mpi/simulator/processor_time.h"

namespace grove {
namespace {

// In units of about one label. By regression on the processor time of single expansions by one
// rank, seven runs on instances of 10 to 40 agents: correlation 0.88 to 0.99. (Expander::work(),
// which the engine goes by, leaves the sets of optimal paths out; they are most of what a rank does
// that knows little yet.)
double work_of(const ExpansionCounts& counts) {
  return static_cast<double>(counts.low_level_expanded) +
         0.55 * static_cast<double>(counts.optimal_nodes) +
         0.85 * static_cast<double>(counts.joint_pairs) +
         2 * static_cast<double>(counts.situations) + 1.7 * static_cast<double>(counts.groups) +
         0.15 * static_cast<double>(counts.path_steps);
}

}  // namespace

void SimulatedWorker::begin(double now, Expander& expander) {
  search_.keep_within_memory();
  node_ = search_.take();
  if (!node_) return;
  const double before_s = processor_time();
  const double before = work_of(expander.counts());
  expander.turn_to(search_.memory());
  expansion_ = expander.expand(node_, search_.ledger().cutoff(), limits_);
  expander.publish();  // nobody else on this rank asks before this turn has ended
  expander.memory()->trim();
  const double processor_s = processor_time() - before_s;
  const double work = work_of(expander.counts()) - before;
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
  search_.finish(std::exchange(node_, nullptr), std::exchange(expansion_, {}));
}

void SimulatedWorker::abandon(double now) {
  tally_.busy_s -= busy_until_ - now;
  busy_until_ = now;
  expansion_ = {};
  expansion_.stopped = true;
  end();
}

}  // namespace grove
