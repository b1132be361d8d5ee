// SPDX-License-Identifier: MIT
// The restricted travelling salesman problem (rTSP; paper, section III-B): one interface, three
// exact back ends. Branches are indexed from the start of a sequence, so every subproblem of the
// partition method is a *sequence class*: a fixed prefix and a set of stops that must not come
// next. (The other branches of the paper, which forbid an edge of the included prefix, are
// infeasible by construction.)
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

// All complete sequences that begin with `prefix` and whose next stop is not in `forbidden_next`
// (Lawler 1972). The default contains every sequence. A class with a complete prefix contains only
// this prefix.
struct SequenceClass {
  Sequence prefix;
  StopSet forbidden_next = 0;
  friend bool operator==(const SequenceClass&, const SequenceClass&) = default;
};

// Result of RtspSolver::best().
struct RtspAnswer {
  enum class Kind : std::uint8_t {
    kExact,        // `cost` is the proven optimum of the class
    kAboveCutoff,  // proven: the optimum exceeds the cutoff (or there is none); `cost` is a proven
                   // lower bound > cutoff
    kInfeasible,   // proven: the class has no sequence of finite cost
    kStopped,      // a limit was reached, or the back end needs too much memory; `cost` is a proven
                   // lower bound, perhaps 0
  };
  Kind kind = Kind::kStopped;
  Time cost = 0;  // of the whole sequence, including the prefix
};

// Solves rTSPs over one cost matrix. One thread at a time; different threads may use different
// solvers (a mutex serializes the CBC back end).
class RtspSolver {
 public:
  virtual ~RtspSolver() = default;

  // Computes the least cost of the class `sequence_class`, or proves that it exceeds `cutoff`. A
  // back end may return kExact even above the cutoff. `sequence_class.prefix` must not repeat a
  // stop. The CBC back end throws std::runtime_error if CBC returns a wrong result.
  virtual RtspAnswer best(const SequenceClass& sequence_class, Time cutoff) = 0;

  // Returns a complete sequence of the class whose cost is the optimum. Call only if best()
  // returned kExact for this class.
  virtual Sequence best_sequence(const SequenceClass& sequence_class) = 0;

  // Returns a proven lower bound on the cost of every complete sequence, without search. kNever:
  // proven that none exists.
  virtual Time root_bound() const = 0;
};

// Back ends of make_rtsp_solver(); n is the number of stops.
enum class RtspBackend : std::uint8_t {
  kAuto,       // Held-Karp table if it is small, else bounded dynamic programming
  kHeldKarp,   // for n up to 26 (kMaxTableStops): 2^n * n table entries
  kBoundedDp,  // sequence graph within a cost limit that grows on demand
  kCbc,        // integer program with subtour cuts
};

// Returns the back ends that this build of Grove contains: all, or all except CBC.
std::vector<RtspBackend> rtsp_backends();
inline bool is_built(RtspBackend backend) {
  return backend != RtspBackend::kCbc || rtsp_backends().back() == backend;
}

// Makes a solver. `matrix` and `limits` must outlive it. Throws std::invalid_argument if the back
// end is not built. A table that does not fit into the memory limit, or would be for more than
// kMaxTableStops stops, is not built; the answers are then kStopped, and the run stops
// (Limits::memory_exhausted).
std::unique_ptr<RtspSolver> make_rtsp_solver(RtspBackend backend, const CostMatrix& matrix,
                                             const Limits& limits);

// The following functions make one back end each. The file with the name of the back end defines
// it.

// Largest number of stops for which kAuto uses a table. A table of this size takes less than 1 ms
// and 0.5 MB (four times that with ports). For more stops, building a sequence graph takes about as
// long and little memory; only long lists of sequences are slower with it.
inline constexpr int kTableStops = 14;

std::unique_ptr<RtspSolver> make_held_karp(const CostMatrix& matrix, const Limits& limits);
// Largest number of states of a graph of all sequences; building it takes about 0.2 s. Beyond it, a
// graph holds only canonical sequences.
inline constexpr std::size_t kMaxGraphStates = std::size_t{1} << 16;
std::unique_ptr<RtspSolver> make_bounded_dp(const CostMatrix& matrix, const Limits& limits,
                                            std::size_t max_states = kMaxGraphStates);
std::unique_ptr<RtspSolver> make_cbc_rtsp(const CostMatrix& matrix, const Limits& limits);

// Returns a proven lower bound on the cost of every complete sequence of `matrix` by a relaxation
// (spanning trees under node potentials). kNever: proven that none exists. Takes about 0.1 ms for
// 10 stops and 2 ms for 36; usually within 1 % of the optimum.
Time relaxation_bound(const CostMatrix& matrix);

}  // namespace grove::detail
