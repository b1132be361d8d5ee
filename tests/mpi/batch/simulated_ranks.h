// SPDX-License-Identifier: MIT
// Simulated ranks that run ordinary blocking code in one process, on a simulated clock.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <random>
#include <vector>

namespace grove::detail::testing {

// Each rank has a thread, but only one thread runs at a time. When it calls pause(), the clock
// advances a little and a randomly chosen rank continues. The same seed gives the same run.
class SimulatedRanks {
 public:
  SimulatedRanks(int ranks, std::uint64_t seed);

  // Runs `body(rank)` on all ranks. Rethrows an exception from any rank. Throws std::runtime_error
  // if the run takes more than 1,000 simulated seconds.
  void run(const std::function<void(int rank)>& body);
  // Lets another rank run. Only the running rank may call it, inside run().
  void pause(int rank);
  double now() const { return now_; }

  // Called each time the clock has advanced. It may call kill().
  std::function<void(double now)> on_time;
  // Ends each rank in its current or next call of pause(); run() then returns.
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
