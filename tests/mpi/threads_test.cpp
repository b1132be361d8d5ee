// SPDX-License-Identifier: MIT
// Tests the distributed engine with threads instead of processes. The ranks share only a network
// that delays messages by random times.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/check.h"
#include "mpi/messages.h"
#include "mpi/solve_distributed.h"
#include "planning/problem.h"
#include "tests/primal/crowd.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace threads_test {

using testing::HangLimit;
using testing::random_crowd;

// A network that preserves the order of messages between two ranks. It delays a message by up to
// `latest` polls of the receiver.
class ThreadNetwork {
 public:
  ThreadNetwork(int ranks, std::int64_t latest, std::uint64_t seed)
      : latest_(latest), dice_(seed), links_(static_cast<std::size_t>(ranks * ranks)) {
    for (int rank = 0; rank < ranks; ++rank) ends_.emplace_back(*this, rank, ranks);
  }

  Transport& at(int rank) { return ends_[static_cast<std::size_t>(rank)]; }
  // Number of pricing replies received so far.
  std::int64_t answers() const { return answers_; }
  bool empty() const {
    for (const auto& link : links_)
      if (!link.empty()) return false;
    return true;
  }

 private:
  class End : public Transport {
   public:
    End(ThreadNetwork& network, int rank, int ranks)
        : network_(network), rank_(rank), ranks_(ranks) {}
    int rank() const override { return rank_; }
    int ranks() const override { return ranks_; }
    std::optional<ReceivedMessage> receive() override {
      const std::lock_guard lock(network_.mutex_);
      ++polls_;
      for (int i = 0; i < ranks_; ++i) {
        const int from = next_++ % ranks_;
        auto& link = network_.link(from, rank_);
        if (link.empty() || link.front().first > polls_) continue;
        ReceivedMessage received{from, std::move(link.front().second)};
        link.pop_front();
        const auto addressed = message::message_of(received.bytes);
        network_.answers_ +=
            std::holds_alternative<message::ForComponent>(addressed.message) && rank_ == 0;
        return received;
      }
      return std::nullopt;
    }

   private:
    void do_send(int to, std::string bytes) override {
      const std::lock_guard lock(network_.mutex_);
      const auto late = static_cast<std::int64_t>(network_.dice_() %
                                                  static_cast<std::uint64_t>(network_.latest_ + 1));
      const auto& receiver = network_.ends_[static_cast<std::size_t>(to)];
      network_.link(rank_, to).emplace_back(receiver.polls_ + late, std::move(bytes));
    }

    ThreadNetwork& network_;
    const int rank_;
    const int ranks_;
    int next_ = 0;
    std::int64_t polls_ = 0;
  };
  // Messages in transit, each with the first poll of the receiver that may return it.
  using Link = std::deque<std::pair<std::int64_t, std::string>>;

  Link& link(int from, int to) {
    return links_[static_cast<std::size_t>(from) * ends_.size() + static_cast<std::size_t>(to)];
  }

  std::mutex mutex_;
  const std::int64_t latest_;
  std::mt19937_64 dice_;
  std::vector<Link> links_;
  std::atomic<std::int64_t> answers_{0};
  std::deque<End> ends_;
};

// Runs one thread per rank and returns the solution of rank 0.
Solution solve_by_ranks(const Instance& instance, const SolveOptions& options, int ranks,
                        ThreadNetwork& network, const Limits& limits, RunObserver& observer) {
  std::optional<Solution> answer;
  {
    std::vector<std::jthread> processes;
    for (int rank = 0; rank < ranks; ++rank)
      processes.emplace_back([&, rank] {
        const Limits own;
        const Limits& limits_here = rank == 0 ? limits : own;
        const Problem problem(instance, limits_here);
        RunObserver silent;
        auto solution = solve_distributed(problem, options, limits_here, network.at(rank),
                                          rank == 0 ? observer : silent, [] {});
        if (rank == 0) answer = std::move(solution);
      });
  }
  return std::move(answer).value();
}

SolveOptions options_with(int threads, Policy policy, Techniques techniques) {
  SolveOptions options;
  options.omega = Omega();
  options.threads = threads;
  options.policy = policy;
  options.techniques = techniques;
  return options;
}

void expect_optima(Policy policy, Techniques techniques) {
  std::int64_t batches = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Instance instance =
        random_crowd({.size = 8, .obstacles = 20, .agents = 5, .tasks = 5}, seed);
    const Solution alone =
        solve(instance, options_with(1, Policy::kFree, Techniques::defaults()), HangLimit());
    ASSERT_EQ(alone.status, Status::kOptimal);
    for (const int ranks : {2, 3})
      for (const int threads : {1, 2}) {
        ThreadNetwork network(ranks, seed % 2 == 0 ? 0 : 10, seed);
        RunObserver silent;
        const Solution solution =
            solve_by_ranks(instance, options_with(threads, policy, techniques), ranks, network,
                           HangLimit(), silent);
        batches += solution.stats.counts.at("node_batches");
        EXPECT_EQ(solution.status, Status::kOptimal)
            << "seed " << seed << ", " << ranks << " ranks, " << threads << " threads";
        EXPECT_EQ(solution.lower_bound, alone.lower_bound) << "seed " << seed;
        EXPECT_TRUE(network.empty());
      }
  }
  EXPECT_GT(batches, 20) << "too few nodes were sent to test anything";
}

TEST(Threads, FindTheOptimumInOneTree) {
  expect_optima(Policy::kFree, {Technique::kTarget, Technique::kStrongBranching});
}

TEST(Threads, FindTheOptimumInManyTrees) {
  expect_optima(Policy::kFixed, {Technique::kTarget, Technique::kStrongBranching});
}

// Interrupts the run once there is a plan and other ranks have solved some pricing problems.
class Interrupter : public RunObserver {
 public:
  explicit Interrupter(const ThreadNetwork& network) : network_(network) {}
  void on_incumbent(const Plan&, PlanSource, const Progress&) override { has_plan_ = true; }
  void on_event(RunEvent, const Progress&) override {
    if (has_plan_ && network_.answers() >= 50) interrupted = true;
  }

  std::atomic<bool> interrupted{false};

 private:
  const ThreadNetwork& network_;
  bool has_plan_ = false;
};

// A dense instance that no search solves before the interrupt. The plan must be valid, and the
// bound must not exceed its cost.
TEST(Threads, PriceSubproblemsForEachOther) {
  const Instance instance =
      random_crowd({.size = 20, .obstacles = 20, .agents = 120, .tasks = 0}, 1);
  std::int64_t prices = 0;
  for (const int threads : {1, 2}) {
    SolveOptions options = options_with(threads, Policy::kFree, Techniques::defaults());
    options.tuning.lagrangian_start_work = 0;
    options.tuning.lagrangian_min_remote_work = 1000;
    ThreadNetwork network(3, 5, 1);
    Interrupter interrupter(network);
    HangLimit limits;
    limits.watch_interrupt(&interrupter.interrupted);
    const Solution solution = solve_by_ranks(instance, options, 3, network, limits, interrupter);
    ASSERT_TRUE(solution.plan);
    EXPECT_TRUE(check(instance, solution).empty());
    EXPECT_LE(solution.lower_bound, solution.plan->cost);
    const auto found = solution.stats.counts.find("remote_pricings");
    if (found != solution.stats.counts.end()) prices += found->second;
    EXPECT_TRUE(network.empty());
  }
  EXPECT_GT(prices, 0);
}

}  // namespace threads_test
}  // namespace grove::detail
