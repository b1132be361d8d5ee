// SPDX-License-Identifier: MIT
// The restricted travelling salesman problem (rTSP; paper, section III-B): one interface, three
// exact back ends. A sequence is indexed from its start, so every subproblem of the partition
// method is a *sequence class*: a fixed prefix and a set of stops that must not come next. (The
// paper's other branches, which forbid an edge of the included prefix, are infeasible by
// construction.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "model/grid.h"
#include "model/limits.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// All complete sequences that begin with `prefix` and whose next stop is not in `forbidden_next`.
// With an empty prefix and nothing forbidden it holds every sequence; with a complete prefix, one.
// (Lawler 1972.)
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
    kInfeasible,   // proven: the class holds no sequence of finite cost
    kStopped,      // a limit was reached; `cost` is a proven lower bound, perhaps 0
  };
  Kind kind = Kind::kStopped;
  Time cost = 0;  // of the whole sequence, prefix included
};

// Solves rTSPs over one cost matrix. One thread at a time; different solvers may be used by
// different threads (a mutex serializes the CBC back end).
class RtspSolver {
 public:
  virtual ~RtspSolver() = default;

  // Solves the class `sequence_class`, if its best member costs at most `cutoff`. Back ends that
  // compute the optimum anyway return kExact even above the cutoff. `sequence_class.prefix` must
  // not repeat a stop.
  virtual RtspAnswer best(const SequenceClass& sequence_class, Time cutoff) = 0;

  // Returns a complete sequence of the cost that the last call best(sequence_class, ...) proved.
  // Call only after kExact.
  virtual Sequence best_sequence(const SequenceClass& sequence_class) = 0;

  // Returns a proven lower bound on every complete sequence, without search.
  virtual Time root_bound() const = 0;
};

enum class RtspBackend : std::uint8_t {
  kAuto,       // Held-Karp table if it is small, else bounded dynamic programming
  kHeldKarp,   // for n up to 26 (kMaxTableStops): 2^n * n table entries
  kBoundedDp,  // sequence graph within a cost limit that grows on demand
  kCbc,        // integer program with subtour cuts
};

// The back ends of this build: all, or all except CBC.
std::vector<RtspBackend> rtsp_backends();
inline bool is_built(RtspBackend backend) {
  return backend != RtspBackend::kCbc || rtsp_backends().back() == backend;
}

// Makes a solver. `matrix` and `limits` must outlive it. Throws std::invalid_argument if the back
// end is not built. Tables that do not fit into the memory limit are not built: the answers are
// then kStopped, and the run stops (Limits::memory_exhausted).
std::unique_ptr<RtspSolver> make_rtsp_solver(RtspBackend backend, const CostMatrix& matrix,
                                             const Limits& limits);

// The back ends of make_rtsp_solver(), each in the file of its name.
//
// Largest number of stops for a table. Up to here a table takes less than a millisecond and 0.5 MB
// (four times that with ports). For more stops, sequence graphs take about as long and stay small;
// only long lists of sequences are slower with them.
inline constexpr int kTableStops = 14;

std::unique_ptr<RtspSolver> make_held_karp(const CostMatrix& matrix, const Limits& limits);
// Largest number of states in a graph of all sequences, about 0.2 s. Larger graphs hold only
// canonical sequences.
inline constexpr std::size_t kMaxGraphStates = std::size_t{1} << 16;
std::unique_ptr<RtspSolver> make_bounded_dp(const CostMatrix& matrix, const Limits& limits,
                                            std::size_t max_states = kMaxGraphStates);
std::unique_ptr<RtspSolver> make_cbc_rtsp(const CostMatrix& matrix, const Limits& limits);

// Returns a proven lower bound on every complete sequence of `matrix`, by relaxation: spanning
// trees under node potentials. kNever: there is proven to be none. Takes about 0.1 ms at n = 10 and
// 2 ms at n = 36; usually within 1 % of the optimum.
Time relaxation_bound(const CostMatrix& matrix);

}  // namespace grove::detail
