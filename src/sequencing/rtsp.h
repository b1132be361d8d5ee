// SPDX-License-Identifier: MIT
// The restricted travelling salesman problem (rTSP; paper, section III-B): one interface, three
// exact back ends. A sequence is indexed from its start, so every subproblem of the partition
// method is a *sequence class*: a fixed prefix and a set of stops that must not come next. (The
// paper's other branches, which forbid an edge of the included prefix, are infeasible by
// construction.)
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "model/grid.h"
#include "model/limits.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// All complete sequences that begin with `prefix` and whose next stop is not in `forbidden_next`.
// The empty class holds every sequence; a complete prefix, one. (Lawler 1972.)
struct SequenceClass {
  Sequence prefix;
  StopSet forbidden_next = 0;
  friend bool operator==(const SequenceClass&, const SequenceClass&) = default;
};

struct RtspAnswer {
  enum class Kind : std::uint8_t {
    kExact,        // `cost` is the proven optimum of the class
    kAboveCutoff,  // proven: the optimum exceeds the cutoff (or there is none); `cost` is a proven
                   // lower bound > cutoff
    kInfeasible,  // proven: the class holds no sequence of finite cost
    kStopped,     // a limit struck; `cost` is a proven lower bound, perhaps 0
  };
  Kind kind = Kind::kStopped;
  Time cost = 0;  // of the whole sequence, prefix included
};

// Solves rTSPs over one cost matrix. Not for two threads at once; different solvers may be used by
// different threads (the CBC back end takes turns behind a mutex).
class RtspSolver {
 public:
  virtual ~RtspSolver() = default;

  // The best member of a class, if it costs at most `cutoff`. Back ends that know the optimum
  // anyway return kExact even above the cutoff. `work.prefix` must not repeat a stop.
  virtual RtspAnswer best(const SequenceClass& work, Time cutoff) = 0;

  // A complete sequence of the cost that best() called last on `work` proved. Only after kExact.
  virtual Sequence best_sequence(const SequenceClass& work) = 0;

  // A proven lower bound on every complete sequence, known without searching.
  virtual Time root_bound() const = 0;
};

enum class RtspBackend : std::uint8_t {
  kAuto,       // Held-Karp table while it is small, else bounded dynamic programming
  kHeldKarp,   // n <= 24 or so: 2^n * n table entries
  kBoundedDp,  // layers of states within reach of the best known sequence
  kCbc,        // integer program with subtour cuts
};

// Those that this Grove is built with: all, or all but CBC.
std::vector<RtspBackend> rtsp_backends();
inline bool is_built(RtspBackend backend) {
  return backend != RtspBackend::kCbc || rtsp_backends().back() == backend;
}

// Throws std::invalid_argument if the back end is not built.
// `matrix` and `limits` must outlive the solver. Tables that the limits' memory does not allow are
// not built: the answers are then kStopped, and so is the run (Limits::memory_exhausted).
std::unique_ptr<RtspSolver> make_rtsp_solver(RtspBackend backend, const CostMatrix& matrix,
                                             const Limits& limits);

// Lower bounds by relaxation: a proven lower bound on every complete sequence of `matrix`; kNever
// when there is proven to be none. Spanning trees under node potentials, some 0.1 ms at n = 10 and
// 2 at 36; usually within 1 % of the optimum.
Time relaxation_bound(const CostMatrix& matrix);

}  // namespace grove::detail
