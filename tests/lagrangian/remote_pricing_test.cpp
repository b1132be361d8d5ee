// SPDX-License-Identifier: MIT
// Tests a Lagrangian bound with remote pricing. Replies can be late, invalid or missing.
#include "lagrangian/remote_pricing.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/fuzz/random.h"
#include "tests/lagrangian/tiny_agents.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::lagrangian_test {
namespace {

Tuning tuning_with_short_rounds(fuzz::Random& random) {
  Tuning tuning;
  tuning.lagrangian_level = random.pick<double>({0.02, 0.3, 1});
  tuning.lagrangian_shrink = random.pick<double>({0.8, 0.99});
  tuning.lagrangian_step_work = 1;
  tuning.lagrangian_min_remote_work = 1;
  tuning.lagrangian_min_rounds = 1000;
  return tuning;
}

// A process that solves pricing problems for the bound, with its replies in transit.
struct HelpingProcess {
  explicit HelpingProcess(TinyProblem& known)
      : help(known.instance), pricer(help.multipliers(), known.stops) {}

  bool work() {
    if (auto job = help.next()) {
      pricer.perform(*job, {});
      help.commit(std::move(*job));
      return true;
    }
    auto answer = help.take_reply();
    if (answer) answers.push_back(std::move(*answer));
    return answer.has_value();
  }

  PricingHelper help;
  Pricer pricer;
  std::deque<PricingReply> answers;
};

// The bound and its helper processes, simulated in one thread in random order.
class Ascent {
 public:
  Ascent(TinyProblem& known, const Tuning& tuning, int helpers, fuzz::Random& random)
      : bound(LagrangianBound::make(known.instance, known.stops, tuning), tuning),
        dispatcher(helpers),
        pricer(bound.multipliers(), known.stops),
        random_(random) {
    for (int i = 0; i < helpers; ++i) processes.emplace_back(known);
  }

  // Performs one random event: a request, a step of a helper, a reply, or a step of the bound
  // itself.
  void step(Cost cutoff) {
    const int helper = random_.below(static_cast<int>(processes.size()));
    HelpingProcess& process = processes[static_cast<std::size_t>(helper)];
    if (random_.percent(30)) {
      for (auto& asked : dispatcher.dispatch(bound))
        processes[static_cast<std::size_t>(asked.helper)].help.accept(std::move(asked.request));
    } else if (random_.percent(50)) {
      process.work();
    } else if (!process.answers.empty() && random_.percent(60)) {
      accepted += dispatcher.accept(helper, std::move(process.answers.front()), bound);
      process.answers.pop_front();
    } else if (auto job = bound.next()) {
      bound.perform(*job, pricer, cutoff, 0, {});
      bound.commit(std::move(*job));
    }
  }

  PricingQueue bound;
  PricingDispatcher dispatcher;
  Pricer pricer;
  std::deque<HelpingProcess> processes;
  int accepted = 0;

 private:
  fuzz::Random& random_;
};

TEST(RemotePricing, NeverRaisesTheBoundAboveTheOptimum) {
  int tried = 0, accepted = 0, rounds = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(200));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = tiny_instance(seed);
    const oracle::Answer truth = oracle::solve_jointly(instance);
    if (!truth.plan || instance.agent_count() < 2) continue;
    TinyProblem known(instance);
    fuzz::Random random(seed);
    const Tuning tuning = tuning_with_short_rounds(random);
    if (!LagrangianBound::make(instance, known.stops, tuning)) continue;
    Ascent ascent(known, tuning, random.between(1, 3), random);
    for (int i = 0; i < 1500 && !ascent.bound.ended(); ++i) {
      ascent.step(truth.plan->cost + 5);
      ASSERT_LE(ascent.bound.lower_bound(), truth.plan->cost) << ascent.bound.rounds();
    }
    ++tried;
    accepted += ascent.accepted;
    rounds += ascent.bound.rounds();
  }
  EXPECT_GT(tried, 80);
  EXPECT_GT(accepted, 700);
  EXPECT_GT(rounds, 2000);
}

class OneHelper : public ::testing::Test {
 protected:
  void work_alone_until_round(int round) {
    while (bound.rounds() < round) {
      auto job = bound.next();
      ASSERT_TRUE(job);
      bound.perform(*job, pricer, 20, 0, {});
      bound.commit(std::move(*job));
    }
  }
  // Runs the bound until it requests pricing. Returns nullopt if it does not within 100 jobs.
  std::optional<PricingRequest> ask() {
    for (int i = 0; i < 100; ++i) {
      auto asked = dispatcher.dispatch(bound);
      if (!asked.empty()) return std::move(asked.front().request);
      auto job = bound.next();
      if (!job) break;
      bound.perform(*job, pricer, 20, 0, {});
      bound.commit(std::move(*job));
    }
    return std::nullopt;
  }
  PricingReply answer_to(PricingRequest request) {
    process.help.accept(std::move(request));
    while (process.work()) {
    }
    PricingReply answer = std::move(process.answers.back());
    process.answers.pop_back();
    return answer;
  }
  TinyProblem known{corridor()};
  Tuning tuning = [] {
    Tuning t;
    t.lagrangian_step_work = t.lagrangian_min_remote_work = 1;
    return t;
  }();
  PricingQueue bound{LagrangianBound::make(known.instance, known.stops, tuning), tuning};
  PricingDispatcher dispatcher{1};
  Pricer pricer{bound.multipliers(), known.stops};
  HelpingProcess process{known};
};

TEST_F(OneHelper, ReplyCountsInItsRound) {
  auto request = ask();
  ASSERT_TRUE(request);
  const auto agents = static_cast<int>(request->known.size());
  EXPECT_EQ(dispatcher.accept(0, answer_to(std::move(*request)), bound), agents);
}

TEST_F(OneHelper, ReplyOfAnotherRoundDoesNotCount) {
  work_alone_until_round(5);
  auto request = ask();
  ASSERT_TRUE(request);
  PricingReply late = answer_to(std::move(*request));
  const auto round = bound.rounds();
  work_alone_until_round(round + 1);  // the bound does not wait for the reply
  EXPECT_FALSE(ask()) << "a reply is outstanding";
  EXPECT_EQ(dispatcher.accept(0, late, bound), 0);
  request = ask();
  ASSERT_TRUE(request) << "no reply is outstanding";
  late.round = request->round;
  late.first = request->first;
  late.values.resize(request->known.size(), 1000 * Penalties::kUnit);
  late.paths.resize(request->known.size());
  EXPECT_EQ(dispatcher.accept(0, late, bound), 0) << "prices under other multipliers";
}

TEST_F(OneHelper, ReplyDoesNotCountAfterTheBoundDidItsPart) {
  auto request = ask();
  ASSERT_TRUE(request);
  PricingReply late = answer_to(std::move(*request));
  work_alone_until_round(1);
  EXPECT_EQ(dispatcher.accept(0, std::move(late), bound), 0);
}

TEST_F(OneHelper, RefusesInvalidRequests) {
  auto request = ask();
  ASSERT_TRUE(request);
  PricingRequest other = *request;
  other.first = 2;
  EXPECT_THROW(process.help.accept(other), std::invalid_argument);
  other.first = 0;
  other.known.clear();
  EXPECT_THROW(process.help.accept(other), std::invalid_argument);
  process.help.accept(*request);
  EXPECT_THROW(process.help.accept(*request), std::invalid_argument) << "one at a time";
}

}  // namespace
}  // namespace grove::detail::lagrangian_test
