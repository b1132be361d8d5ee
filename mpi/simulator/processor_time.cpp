// SPDX-License-Identifier: MIT
#include "mpi/simulator/processor_time.h"

#include <ctime>

namespace grove::detail {

double processor_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace grove::detail
