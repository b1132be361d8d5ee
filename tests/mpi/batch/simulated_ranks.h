// SPDX-License-Identifier: MIT
// Ranks that run ordinary, waiting code in one process, on a clock of their own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <random>
#include <vector>

namespace grove::detail::testing {

// Each rank has a thread, but only one of them runs at a time: until it calls pause(), when time
// goes on a little and some rank, chosen at random, has its turn. The same seed, the same run.
class SimulatedRanks {
 public:
  SimulatedRanks(int ranks, std::uint64_t seed);

  // Runs `body(rank)` on all ranks. Rethrows what one of them throws, std::runtime_error when there
  // is no end.
  void run(const std::function<void(int rank)>& body);
  // To be called by the rank whose turn it is, inside run().
  void pause(int rank);
  double now() const { return now_; }

  // Called whenever time has gone on. May call kill().
  std::function<void(double now)> on_time;
  // Ends all ranks where they stand, as if by SIGKILL: run() returns.
  void kill() { killed_ = true; }
  bool killed() const { return killed_; }

 private:
  struct Killed {};
  void run_rank(int rank, const std::function<void(int rank)>& body);
  void wait_for_turn(std::unique_lock<std::mutex>& lock, int rank);
  void pass_turn();

  std::vector<bool> alive_;
  std::mt19937_64 random_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int turn_;
  double now_ = 0;
  bool killed_ = false;
  std::exception_ptr failure_;
};

}  // namespace grove::detail::testing
