// SPDX-License-Identifier: MIT
#include "simulated_ranks.h"

#include <stdexcept>
#include <thread>

namespace grove::detail::testing {
namespace {

constexpr int kNoAgent = -1;
constexpr double kMaxStep_s = 0.001;
constexpr double kNoEnd_s = 1000;

}  // namespace

SimulatedRanks::SimulatedRanks(int ranks, std::uint64_t seed)
    : alive_(static_cast<std::size_t>(ranks), true), random_(seed), turn_(kNoAgent) {}

void SimulatedRanks::run(const std::function<void(int rank)>& body) {
  std::vector<std::jthread> threads;
  for (int rank = 0; rank < static_cast<int>(alive_.size()); ++rank)
    threads.emplace_back([this, rank, &body] { run_rank(rank, body); });
  {
    std::unique_lock lock(mutex_);
    pass_turn();
    changed_.wait(lock, [&] { return turn_ == kNoAgent; });
  }
  threads.clear();
  if (failure_) std::rethrow_exception(failure_);
}

void SimulatedRanks::run_rank(int rank, const std::function<void(int rank)>& body) {
  try {
    {
      std::unique_lock lock(mutex_);
      wait_for_turn(lock, rank);
    }
    body(rank);
  } catch (const Killed&) {
    // thrown because of kill()
  } catch (...) {
    if (!failure_) failure_ = std::current_exception();
    killed_ = true;
  }
  const std::unique_lock lock(mutex_);
  alive_[static_cast<std::size_t>(rank)] = false;
  pass_turn();
}

void SimulatedRanks::pause(int rank) {
  std::unique_lock lock(mutex_);
  now_ += std::uniform_real_distribution<double>(0, kMaxStep_s)(random_);
  if (now_ > kNoEnd_s) throw std::runtime_error("the ranks do not end");
  if (on_time) on_time(now_);
  pass_turn();
  wait_for_turn(lock, rank);
}

void SimulatedRanks::wait_for_turn(std::unique_lock<std::mutex>& lock, int rank) {
  changed_.wait(lock, [&] { return turn_ == rank; });
  if (killed_) throw Killed{};
}

void SimulatedRanks::pass_turn() {
  std::vector<int> ranks;
  for (int rank = 0; rank < static_cast<int>(alive_.size()); ++rank)
    if (alive_[static_cast<std::size_t>(rank)]) ranks.push_back(rank);
  turn_ = ranks.empty()
              ? kNoAgent
              : ranks[std::uniform_int_distribution<std::size_t>(0, ranks.size() - 1)(random_)];
  changed_.notify_all();
}

}  // namespace grove::detail::testing
