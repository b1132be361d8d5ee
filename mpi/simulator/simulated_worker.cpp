// SPDX-License-Identifier: MIT
#include "mpi/simulator/simulated_worker.h"

#include <utility>

#include "mpi/simulator/processor_time.h"

namespace grove {
namespace {

constexpr double kStepsPerWork = 4;  // of the paths of a node that is looked through; as Worker

}  // namespace

void SimulatedWorker::begin(double now, Expander& expander) {
  search_.keep_within_memory();
  node_ = search_.take();
  if (!node_) return;
  const double before_s = processor_time();
  const std::int64_t before = expander.work();
  expander.turn_to(search_.memory());
  expansion_ = expander.expand(node_, search_.ledger().cutoff(), limits_);
  expander.publish();  // nobody else on this rank asks before this turn has ended
  const double processor_s = processor_time() - before_s;
  const double work = static_cast<double>(expander.work() - before) +
                      static_cast<double>(node_->cost()) / kStepsPerWork + 1;
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
