// SPDX-License-Identifier: MIT
// Counts active constraints. A side "A rest P T" implies "B bar P T inf" for each other agent B.
// The implied constraints have no counts of their own. Instead, each (P, T) has a count `others`,
// the number of active sides "rest P T" over all agents, and each agent has a count `own`, the
// number of those on this agent. "B bar P T inf" is implied if `others` exceeds the `own` of B.
// (This also reports the constraint for agents outside the proof, which is harmless, because no
// lemma that the proof may name has a constraint on such an agent.)
#include "proof/active_constraints.h"

#include "model/assert.h"
#include "model/hash.h"

namespace grove::detail {
namespace {

using Kind = CertificateConstraint::Kind;
constexpr AgentIndex kAllAgents = -1;

CertificateConstraint own(AgentIndex agent, std::int32_t place, std::int32_t time) {
  return {agent, Kind::kRest, place, 1, time, time};
}

CertificateConstraint others(std::int32_t place, std::int32_t time) {
  return own(kAllAgents, place, time);
}

bool is_for_ever(const CertificateConstraint& constraint) {
  return constraint.kind == Kind::kVertexOrEdge &&
         constraint.end == CertificateConstraint::kForEver;
}

}  // namespace

CertificateConstraint constraint_of(const CertificateLate& side) {
  return {side.agent, Kind::kNoRest, kSomeGoal, 0, side.time, side.time};
}

bool ActiveConstraints::has(const CertificateConstraint& constraint) const {
  if (times(constraint) > 0) return true;
  return is_for_ever(constraint) &&
         times(others(constraint.p, constraint.begin)) >
             times(own(constraint.agent, constraint.p, constraint.begin));
}

bool ActiveConstraints::has_side(const CertificateConstraint& side) const {
  // A "rest" that is a constraint of a lemma implies nothing for other agents, so only sides count.
  if (side.kind == Kind::kRest) return times(own(side.agent, side.p, side.begin)) > 0;
  return has(side);
}

bool ActiveConstraints::is_of(const CertificateConstraint& constraint,
                              const CertificateConstraint& side) const {
  if (side.kind == Kind::kRest && is_for_ever(constraint))
    return constraint.p == side.p && constraint.begin == side.begin &&
           constraint.agent != side.agent;
  if (side.p != kSomeGoal) return constraint == side;
  // `side` is of "later". A `norest` that no other line imposes must be the one on the goal.
  return constraint.kind == Kind::kNoRest && constraint.agent == side.agent &&
         constraint.end == side.end && !has(constraint);
}

std::size_t ActiveConstraints::Hash::operator()(const CertificateConstraint& constraint) const {
  std::uint64_t hash = static_cast<std::uint64_t>(constraint.kind);
  for (const std::int32_t value :
       {constraint.agent, constraint.p, constraint.q, constraint.begin, constraint.end})
    hash = hash_combine(hash, static_cast<std::uint64_t>(value));
  return hash;
}

void ActiveConstraints::count(const CertificateConstraint& side, int more) {
  count_one(side, more);
  if (side.kind != Kind::kRest) return;
  count_one(own(side.agent, side.p, side.begin), more);
  count_one(others(side.p, side.begin), more);
}

void ActiveConstraints::count_one(const CertificateConstraint& constraint, int more) {
  const auto found = counts_.try_emplace(constraint, 0).first;
  GROVE_CHECK(found->second + more >= 0, "a side is undone only after it was assumed");
  if ((found->second += more) == 0) counts_.erase(found);
}

int ActiveConstraints::times(const CertificateConstraint& constraint) const {
  const auto found = counts_.find(constraint);
  return found == counts_.end() ? 0 : found->second;
}

}  // namespace grove::detail
