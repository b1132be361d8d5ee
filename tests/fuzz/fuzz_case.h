// SPDX-License-Identifier: MIT
// An instance and the options to solve it with: one thing the fuzzer tries.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/solve.h"
#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// What may strike during a run.
enum class Strike : std::uint8_t {
  kNothing,    // only a generous deadline
  kExpired,    // the deadline has passed when the run begins
  kSoon,       // the deadline comes within a millisecond
  kMemory,     // there is hardly any memory
  kInterrupt,  // the interrupt flag is up when the run begins
};

// As text: a TinyInstance, followed by
//
//     options
//     omega 0.01
//     policy free          (auto, fixed, free)
//     rtsp held-karp       (auto, held-karp, bounded-dp, cbc)
//     low-level forest     (own, visited-sets, single-legs, forest)
//     seed 7
//     threads 2
//     deterministic yes
//     without bypass       (a technique; may come again)
//     node-memory 4000     (bytes)
//     tune bypasses=2      (a number of the search; may come again)
//     strike nothing       (nothing, expired, soon, memory, interrupt)
//
// in which every line may be missing.
struct FuzzCase {
  FuzzCase() { options.audit = true; }

  TinyInstance instance;
  SolveOptions options;
  Strike strike = Strike::kNothing;

  std::string to_text() const;
  // Throws std::invalid_argument.
  static FuzzCase parse(std::string_view text);
};

// A random instance with random options. The same seed makes the same case.
FuzzCase random_case(std::uint64_t seed);

}  // namespace grove::detail::fuzz
