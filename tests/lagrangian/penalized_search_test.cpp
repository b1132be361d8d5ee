// SPDX-License-Identifier: MIT
#include "lagrangian/penalized_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lagrangian/relaxed_rows.h"
#include "tests/fuzz/random.h"
#include "tests/lagrangian/tiny_agents.h"

namespace grove::detail::lagrangian_test {
namespace {

using Amount = Penalties::Amount;
constexpr Time kPenalized = 14;  // no penalties from this time on
constexpr Time kHorizon = 200;   // later than any useful finish of a tiny agent, waits included

// Adds random penalties to arcs of the world, at random times before kPenalized.
void penalize(Penalties& penalties, fuzz::Random& random) {
  const World& world = penalties.world();
  for (Time time = 1; time < kPenalized; ++time)
    for (Place place = 0; place < world.place_count(); ++place) {
      if (random.percent(30))
        penalties.add(time, penalties.staying(place), random.below(3 * Penalties::kUnit));
      for (const Place next : world.neighbors(place))
        if (random.percent(30))
          penalties.add(time, penalties.arc(place, next), random.below(3 * Penalties::kUnit));
    }
}

std::vector<Amount> random_on_finish(fuzz::Random& random) {
  std::vector<Amount> on_finish(static_cast<std::size_t>(random.between(0, kPenalized)));
  for (Amount& amount : on_finish) amount = random.below(2 * Penalties::kUnit);
  return on_finish;
}

// Reference: dynamic programming over the graph of the agent's states, one time step after another.
class Reference {
 public:
  Reference(const AgentGraph& graph, const Penalties& penalties, const std::vector<Amount>& finish)
      : graph_(graph), penalties_(penalties), finish_(finish) {}

  // Returns the least penalized cost of a path that respects the reservations of `others` and
  // finishes at time `latest` or earlier; kMaxPenaltyCost if there is no such path.
  ScaledCost price(const ReservationTable& others, Time latest = kHorizon) const {
    constexpr ScaledCost kNo = PenalizedSearch::kMaxPenaltyCost;
    std::vector<ScaledCost> paid(graph_.count(), kNo);
    std::vector<ScaledCost> moved(graph_.count(), kNo);  // only paths that end with a move
    if (graph_.count() == 0) return kNo;
    paid[AgentGraph::start()] = moved[AgentGraph::start()] = 0;
    ScaledCost least = kNo;
    for (Time time = 0; time <= latest; ++time) {
      std::vector<ScaledCost> next(graph_.count(), kNo);
      std::vector<ScaledCost> next_moved(graph_.count(), kNo);
      for (AgentGraph::Node node = 0; node < graph_.count(); ++node) {
        if (paid[node] >= kNo) continue;
        for (const AgentGraph::Move& move : graph_.moves(node)) {
          if (graph_.rests(move.to)) {
            if (moved[node] < kNo && others.may_rest_from(graph_.place(node), time))
              least = std::min(least, moved[node] + rest(node, time));
            continue;
          }
          if (!others.may_arrive(graph_.place(node), graph_.place(move.to), time + 1)) continue;
          const auto arc = penalties_.arc(graph_.place(node), graph_.place(move.to));
          const ScaledCost price = paid[node] + Penalties::kUnit + penalties_.of(time + 1, arc);
          next[move.to] = std::min(next[move.to], price);
          if (graph_.state(move.to) != graph_.state(node))
            next_moved[move.to] = std::min(next_moved[move.to], price);
        }
      }
      paid = std::move(next);
      moved = std::move(next_moved);
    }
    return least;
  }

 private:
  ScaledCost rest(AgentGraph::Node node, Time time) const {
    ScaledCost price = static_cast<std::size_t>(time) < finish_.size() ? finish_[time] : 0;
    for (Time t = time + 1; t < penalties_.end(); ++t)
      price += penalties_.of(t, penalties_.staying(graph_.place(node)));
    return price;
  }

  const AgentGraph& graph_;
  const Penalties& penalties_;
  const std::vector<Amount>& finish_;
};

// Returns the penalized cost of a path: its finish time, the penalty on that finish, and the
// penalties of its steps and of its rest.
ScaledCost paid_by(const Path& path, const Penalties& penalties,
                   const std::vector<Amount>& on_finish) {
  const World& world = penalties.world();
  const auto finish = static_cast<Time>(path.size()) - 1;
  ScaledCost price = ScaledCost{finish} * Penalties::kUnit;
  if (finish < std::ssize(on_finish)) price += on_finish[finish];
  for (Time time = 1; time < std::max(penalties.end(), finish + 1); ++time)
    price += penalties.of(
        time, penalties.arc(place_at(world, path, time - 1), place_at(world, path, time)));
  return price;
}

TEST(PenalizedSearch, FindsTheLeastPrice) {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    TinyProblem known(tiny_instance(seed));
    fuzz::Random random(seed);
    Penalties penalties(known.instance.world());
    penalize(penalties, random);
    PenalizedSearch search(penalties);
    for (AgentIndex agent = 0; agent < known.instance.agent_count(); ++agent) {
      const auto graph = AgentGraph::make(known.instance, agent);
      if (!graph || graph->count() == 0) continue;
      SequenceStages goals(known.stops.of(agent), SequenceClass{});
      ASSERT_LE(min_cost(goals, {}), graph->to_go(AgentGraph::start()));
      goals.cost_to_go().extend(kHorizon, {});
      const std::vector<Amount> on_finish = random_on_finish(random);
      const ScaledCost least =
          Reference(*graph, penalties, on_finish).price(ReservationTable(known.instance.world()));
      Path path;
      ASSERT_EQ(
          search.search(goals, on_finish, PenalizedSearch::kMaxPenaltyCost, 1 << 20, {}, &path),
          least);
      ASSERT_FALSE(path.empty());
      ASSERT_EQ(paid_by(path, penalties, on_finish), least);
      // No path has a lower penalized cost than the least one.
      Path none;
      EXPECT_EQ(search.search(goals, on_finish, least, 1 << 20, {}, &none), least);
      EXPECT_TRUE(none.empty());
      ++tried;
    }
  }
  EXPECT_GT(tried, 500);
}

// Improves paths around the reservations of other agents, with a limit on the finish time.
TEST(PenalizedSearch, ImprovesPathAroundReservations) {
  int improved = 0, infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    TinyProblem known(tiny_instance(seed));
    const Instance& instance = known.instance;
    fuzz::Random random(seed);
    Penalties penalties(instance.world());
    PenalizedSearch search(penalties);
    ReservationTable others(instance.world(), random.percent(20) ? 1 : 0);
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
      const auto graph = AgentGraph::make(instance, agent);
      if (!graph || graph->count() == 0) continue;
      SequenceStages goals(known.stops.of(agent), SequenceClass{});
      goals.cost_to_go().extend(kHorizon, {});
      const std::vector<Amount> on_finish = random_on_finish(random);
      const Time latest = random.below(20);
      const ScaledCost least = Reference(*graph, penalties, on_finish).price(others, latest);
      Path path;
      const bool found = search.improve(goals, on_finish, others, latest,
                                        PenalizedSearch::kMaxPenaltyCost, 1 << 20, {}, path);
      ASSERT_EQ(found, least < PenalizedSearch::kMaxPenaltyCost);
      ++(found ? improved : infeasible);
      if (found) {
        ASSERT_EQ(paid_by(path, penalties, on_finish), least);
        ASSERT_LE(std::ssize(path), latest + 1);
        ASSERT_TRUE(others.may_rest_from(instance.world().place(path.back()),
                                         static_cast<Time>(path.size()) - 1));
        Path same = path;
        EXPECT_FALSE(search.improve(goals, on_finish, others, latest, least, 1 << 20, {}, same));
        EXPECT_EQ(same, path);
        others.add(agent, path);
      }
      if (agent == 0) penalize(penalties, random);
    }
  }
  EXPECT_GT(improved, 400);
  EXPECT_GT(infeasible, 50);
}

// A search that reaches its label limit returns a lower bound on the least penalized cost.
TEST(PenalizedSearch, IsNeverAboveTheLeastPriceWhenCutShort) {
  int cut_short = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    TinyProblem known(tiny_instance(seed));
    fuzz::Random random(seed);
    Penalties penalties(known.instance.world());
    penalize(penalties, random);
    PenalizedSearch search(penalties);
    for (AgentIndex agent = 0; agent < known.instance.agent_count(); ++agent) {
      SequenceStages goals(known.stops.of(agent), SequenceClass{});
      if (min_cost(goals, {}) >= kNever) continue;
      const ScaledCost least =
          search.search(goals, {}, PenalizedSearch::kMaxPenaltyCost, 1 << 20, {}, nullptr);
      for (const std::int64_t labels : {1, 5, 20, 100}) {
        const ScaledCost price =
            search.search(goals, {}, PenalizedSearch::kMaxPenaltyCost, labels, {}, nullptr);
        EXPECT_LE(price, least);
        EXPECT_GE(price, ScaledCost{min_cost(goals, {})} * Penalties::kUnit);
        cut_short += price < least;
      }
    }
  }
  EXPECT_GT(cut_short, 50);
}

}  // namespace
}  // namespace grove::detail::lagrangian_test
