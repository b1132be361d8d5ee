// SPDX-License-Identifier: MIT
// Tasks for threads.
#pragma once

#include <oneapi/tbb/task_group.h>

#include <mutex>
#include <utility>

namespace grove::detail {

#ifdef __SANITIZE_THREAD__
// The thread sanitizer cannot see how TBB hands a task from one thread to another. It is shown by a
// lock on both sides, and the task itself is read behind its back.
inline constinit std::mutex handing_over;
inline void hand_over() {
  const std::lock_guard lock(handing_over);
}
#else
inline void hand_over() {}
#endif

// A tbb::task_group that the thread sanitizer understands.
class Tasks {
 public:
  template <class Do>
  void run(Do what) {
    hand_over();
    group_.run(Task<Do>{std::move(what)});
  }
  // Returns when all tasks have ended; throws what one of them threw.
  void wait() {
    group_.wait();
    hand_over();
  }

 private:
  struct Ending {
    ~Ending() { hand_over(); }
  };
  template <class Do>
  struct Task {
    Do what;
    [[gnu::no_sanitize_thread]] void operator()() const {
      const Do mine = what;
      hand_over();
      const Ending ending;
      mine();
    }
  };

  tbb::task_group group_;
};

}  // namespace grove::detail
