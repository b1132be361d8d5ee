// SPDX-License-Identifier: MIT
// Counts of active constraints. A side "A rest P T" implies "B bar P T inf" for each other agent B.
// These are not counted one by one, but by two counts per (P, T): `others`, the number of active
// sides "rest P T" of any agent, and `own`, the number of those of one agent. "B bar P T inf" is
// implied if `others` exceeds the `own` of B. (So it is also implied for agents outside the proof.
// That is harmless: no lemma that the proof may name has a constraint on them.)
#include "proof/active_constraints.h"

#include "model/hash.h"

namespace grove::detail {
namespace {

using Kind = CertificateDemand::Kind;
constexpr AgentIndex kAnybody = -1;

CertificateDemand own(AgentIndex agent, std::int32_t place, std::int32_t time) {
  return {agent, Kind::kRest, place, 1, time, time};
}

CertificateDemand others(std::int32_t place, std::int32_t time) {
  return own(kAnybody, place, time);
}

bool is_for_ever(const CertificateDemand& demand) {
  return demand.kind == Kind::kVertexOrEdge && demand.end == CertificateDemand::kForEver;
}

}  // namespace

CertificateDemand demand_of(const CertificateLate& side) {
  return {side.agent, Kind::kNoRest, kSomeGoal, 0, side.time, side.time};
}

bool ActiveConstraints::has(const CertificateDemand& demand) const {
  if (times(demand) > 0) return true;
  return is_for_ever(demand) &&
         times(others(demand.p, demand.begin)) > times(own(demand.agent, demand.p, demand.begin));
}

bool ActiveConstraints::has_side(const CertificateDemand& side) const {
  // A "rest" of a lemma implies nothing for other agents, so it does not count here.
  if (side.kind == Kind::kRest) return times(own(side.agent, side.p, side.begin)) > 0;
  return has(side);
}

bool ActiveConstraints::is_of(const CertificateDemand& demand,
                              const CertificateDemand& side) const {
  if (side.kind == Kind::kRest && is_for_ever(demand))
    return demand.p == side.p && demand.begin == side.begin && demand.agent != side.agent;
  if (side.p != kSomeGoal) return demand == side;
  // A constraint that nothing else imposes must be that on the goal.
  return demand.kind == Kind::kNoRest && demand.agent == side.agent && demand.end == side.end &&
         !has(demand);
}

std::size_t ActiveConstraints::Hash::operator()(const CertificateDemand& demand) const {
  std::uint64_t hash = static_cast<std::uint64_t>(demand.kind);
  for (const std::int32_t value : {demand.agent, demand.p, demand.q, demand.begin, demand.end})
    hash = hash_combine(hash, static_cast<std::uint64_t>(value));
  return hash;
}

void ActiveConstraints::count(const CertificateDemand& side, int more) {
  count_one(side, more);
  if (side.kind != Kind::kRest) return;
  count_one(own(side.agent, side.p, side.begin), more);
  count_one(others(side.p, side.begin), more);
}

void ActiveConstraints::count_one(const CertificateDemand& demand, int more) {
  const auto found = counts_.try_emplace(demand, 0).first;
  if ((found->second += more) == 0) counts_.erase(found);
}

int ActiveConstraints::times(const CertificateDemand& demand) const {
  const auto found = counts_.find(demand);
  return found == counts_.end() ? 0 : found->second;
}

}  // namespace grove::detail
