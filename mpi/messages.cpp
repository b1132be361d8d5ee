// SPDX-License-Identifier: MIT
#include "mpi/messages.h"

#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/variant.hpp>

namespace grove::detail {

template <class Archive>
void serialize(Archive& archive, GroupBound& finding) {
  archive(finding.node, finding.agents, finding.known.excess, finding.known.exact,
          finding.known.expansions);
}

template <class Archive>
void serialize(Archive& archive, SubproblemRecord& s) {
  archive(s.tree, s.agent, s.constraints.bytes);
}

template <class Archive>
void serialize(Archive& archive, LearnedBound& fact) {
  archive(fact.agents, fact.cost.lower_bound, fact.cost.exact, fact.cost.was_aborted,
          fact.excess.excess, fact.excess.exact, fact.excess.expansions);
}

// Writes the number without compression. The memory of a process differs from run to run, so with a
// variable width the lengths of messages would differ between equal simulations.
template <class Archive>
void at_full_width(Archive& archive, std::int64_t& number) {
  archive(cereal::binary_data(&number, sizeof number));
}

template <class Archive>
void serialize(Archive& archive, MemoryUse& m) {
  for (std::int64_t* bytes : {&m.process, &m.nodes, &m.prices, &m.path_sets, &m.groups})
    at_full_width(archive, *bytes);
}

template <class Archive>
void serialize(Archive& archive, ProcessStatistics& report) {
  archive(report.counts, report.memory);
}

template <class Archive>
void serialize(Archive& archive, RankStatistics& rank) {
  archive(rank.expanded, rank.open, rank.bound, rank.low_level_calls, rank.branching_cost_queries);
  at_full_width(archive, rank.memory);
}

template <class Archive>
void serialize(Archive& archive, RunStatistics& statistics) {
  archive(statistics.whole, statistics.ranks);
}

namespace message {

template <class Archive>
void serialize(Archive& archive, ForComponent& f) {
  enumerated(archive, f.message.component, kLastComponent);
  archive(f.message.bytes);
}

template <class Archive>
void serialize(Archive& archive, Surplus& surplus) {
  archive(surplus.bound, surplus.nodes, surplus.next);
}

template <class Archive>
void serialize(Archive& archive, WorkRequest& want) {
  archive(want.rank, want.idle, want.best);
}

template <class Archive>
void serialize(Archive& archive, BatchReceived& taken) {
  archive(taken.by, taken.from, taken.batches);
}

template <class Archive>
void serialize(Archive& archive, Status& s) {
  archive(s.bound, s.evicted_bound, s.proven, s.live, s.open, s.expanded, s.epoch, s.assigned);
  enumerated(archive, s.proven_by, kLastComponent);
  enumerated(archive, s.stopped, StopReason::kInterrupt);
  archive(s.surplus, s.work_requests, s.taken);
}

template <class Archive>
void serialize(Archive& archive, NewPlan& found) {
  archive(found.plan);
  enumerated(archive, found.source, kLastPlanSource);
}

template <class Archive>
void serialize(Archive& archive, ProcessStatistics& report) {
  archive(report.statistics);
}

template <class Archive>
void serialize(Archive& archive, RankFinished& send_finished) {
  archive(send_finished.statistics, send_finished.messages);
}

template <class Archive>
void serialize(Archive& archive, NodeBatch& batch) {
  archive(batch.epoch, batch.nodes, batch.findings);
}

template <class Archive>
void serialize(Archive& archive, LearnedBounds& facts) {
  archive(facts.reach, facts.facts);
}

template <class Archive>
void serialize(Archive& archive, NewTree& tree) {
  archive(tree.number, tree.tree);
}

template <class Archive>
void serialize(Archive& archive, AssignNodes& assign) {
  archive(assign.nodes, assign.evicted_bound);
}

template <class Archive>
void serialize(Archive& archive, SnapshotTaken& gathered) {
  archive(gathered.evicted_bound);
}

template <class Archive>
void serialize(Archive& archive, SnapshotPart& part) {
  archive(part.nodes, part.last);
}

template <class Archive>
void serialize(Archive& archive, SendNodes& order) {
  archive(order.to, order.count, order.to_idle);
}

template <class Archive>
void serialize(Archive& archive, ReleaseCustody& release) {
  archive(release.from, release.to, release.batches);
}

template <class Archive>
void serialize(Archive& archive, Incumbent& incumbent) {
  archive(incumbent.plan);
}

template <class Archive>
void serialize(Archive& archive, Restart& restart) {
  archive(restart.proven);
}

template <class Archive>
void serialize(Archive& archive, MessageCounts& message_counts) {
  archive(message_counts.messages);
}

template <class Archive>
void serialize(Archive& archive, Addressed& addressed) {
  std::uint8_t level = 0;
  archive(level, addressed.message);
  addressed.level = level;
}

// Has the serialized form of an Addressed, but refers to the message instead of copying it.
struct AddressedView {
  std::uint8_t level;
  const Message& message;
};

template <class Archive>
void save(Archive& archive, const AddressedView& parts) {
  archive(parts.level, parts.message);
}

void add(const RankFinished& part, RankFinished& sum) {
  detail::add(part.statistics, sum.statistics);
  for (const auto& [rank, messages] : part.messages) sum.messages[rank] += messages;
}

std::string packed(const LearnedBound& fact) {
  return to_bytes(fact);
}

LearnedBound unpacked(std::string_view bytes) {
  return from_bytes<LearnedBound>(bytes);
}

std::string bytes_of(const Message& message, int level) {
  return to_bytes(AddressedView{static_cast<std::uint8_t>(level), message});
}

Addressed message_of(std::string_view bytes) {
  return from_bytes<Addressed>(bytes);
}

}  // namespace message
}  // namespace grove::detail
