// SPDX-License-Identifier: MIT
// Threads that do one piece of work after another together.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace grove::detail {

// Only the thread that made it may use it.
class ThreadTeam {
 public:
  // `threads` >= 1, of which the caller's is one. The system may grant fewer.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return static_cast<int>(others_.size()) + 1; }

  // Calls work(i) on every thread i of the team, 0 being the caller's, and returns when all calls
  // have returned. Then throws what one of them threw.
  void run(const std::function<void(int thread)>& work);

 private:
  void serve(int thread);
  void perform(const std::function<void(int thread)>& work, int thread);

  std::mutex mutex_;  // guards all below, except others_
  std::condition_variable begun_;
  std::condition_variable ended_;
  const std::function<void(int thread)>* work_ = nullptr;
  int round_ = 0;  // of calls of run()
  int busy_ = 0;   // others that still work in this round
  bool closed_ = false;
  std::exception_ptr thrown_;
  std::vector<std::thread> others_;
};

}  // namespace grove::detail
