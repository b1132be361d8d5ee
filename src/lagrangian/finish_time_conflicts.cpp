// SPDX-License-Identifier: MIT
// *Claim: suppose that for every a' <= a and b' <= b the MDDs of two agents for finish times
// exactly a' and b' are dependent (joint_mdd_search.h: all pairs of their paths collide), or one of
// them is empty. Then any two paths of these agents that finish by a and by b collide.* *Proof.* A
// path that finishes by time a finishes exactly at some a' <= a, so it is in the MDD for a'. The
// same holds for b. *Consequence.* No plan contains two such paths, whatever the other agents do.
// If an MDD was not built, because it is too large or a limit was reached, nothing is proven.
#include "lagrangian/finish_time_conflicts.h"

#include "lagrangian/penalized_search.h"

namespace grove::detail {
namespace {

constexpr std::size_t kBytesOfNode = 24;  // approximate size of an MDD node with its edges

}  // namespace

FinishTimeConflicts::FinishTimeConflicts(const World& world, AgentStopsCache& stops,
                                         MaxSizes max_sizes)
    : world_(world), stops_(stops), max_sizes_(max_sizes), builder_(world), dependency_(world) {}
FinishTimeConflicts::~FinishTimeConflicts() = default;

bool FinishTimeConflicts::are_incompatible(const FinishTimePair& pair, const Limits& limits) {
  const Time later_a = pair.finish_a - of(pair.a, limits).earliest;
  const Time later_b = pair.finish_b - of(pair.b, limits).earliest;
  if (later_a >= kGrid || later_b >= kGrid) return false;
  Grid& grid =
      known_[static_cast<std::uint64_t>(pair.a) << 32 | static_cast<std::uint32_t>(pair.b)];
  for (Time a = 0; a <= later_a; ++a)
    for (Time b = 0; b <= later_b; ++b) {
      Verdict& known = grid[static_cast<std::size_t>(a * kGrid + b)];
      if (known == Verdict::kUnknown) known = compared(pair, a, b, limits);
      if (known == Verdict::kNotExcluded) return false;
    }
  return true;
}

FinishTimePair FinishTimeConflicts::extended(FinishTimePair pair, const Limits& limits) {
  for (bool grows = true; grows;) {
    grows = false;
    for (Time FinishTimePair::*finish : {&FinishTimePair::finish_a, &FinishTimePair::finish_b}) {
      FinishTimePair later = pair;
      ++(later.*finish);
      if (!are_incompatible(later, limits)) continue;
      pair = later;
      grows = true;
    }
  }
  return pair;
}

// Tests the paths that finish exactly `later_a` and `later_b` steps after OfAgent::earliest of
// their agents.
FinishTimeConflicts::Verdict FinishTimeConflicts::compared(const FinishTimePair& pair, Time later_a,
                                                           Time later_b, const Limits& limits) {
  const Mdd* const a = mdd(pair.a, later_a, limits);
  const Mdd* const b = a ? mdd(pair.b, later_b, limits) : nullptr;
  if (b == nullptr) return Verdict::kNotExcluded;
  const bool is_excluded =
      a->empty() || b->empty() ||
      dependency_.find(*a, *b, max_sizes_.joint_mdd_nodes, limits) == Dependence::kDependent;
  return is_excluded ? Verdict::kExcluded : Verdict::kNotExcluded;
}

const Mdd* FinishTimeConflicts::mdd(AgentIndex agent, Time later, const Limits& limits) {
  OfAgent& of_agent = of(agent, limits);
  const auto at = static_cast<std::size_t>(later);
  for (auto& mdds = of_agent.mdds; mdds.size() <= at;) {
    auto paths = std::make_unique<Mdd>();
    const Time cost = of_agent.earliest + static_cast<Time>(mdds.size());
    const auto outcome =
        bytes_ > max_sizes_.bytes
            ? MddBuilder::Outcome::kTooLarge
            : builder_.build(*of_agent.goals, {}, cost, max_sizes_.mdd_nodes, limits, *paths);
    const bool is_known =
        outcome == MddBuilder::Outcome::kBuilt || outcome == MddBuilder::Outcome::kNone;
    bytes_ += static_cast<std::size_t>(paths->node_count()) * kBytesOfNode;
    mdds.push_back(is_known ? std::move(paths) : nullptr);
  }
  return of_agent.mdds[at].get();
}

FinishTimeConflicts::OfAgent& FinishTimeConflicts::of(AgentIndex agent, const Limits& limits) {
  if (static_cast<std::size_t>(agent) >= agents_.size()) agents_.resize(agent + 1);
  OfAgent& of_agent = agents_[agent];
  if (!of_agent.goals) {
    of_agent.goals = std::make_unique<SequenceStages>(stops_.of(agent), SequenceClass{});
    of_agent.earliest = min_cost(*of_agent.goals, limits);
  }
  return of_agent;
}

}  // namespace grove::detail
