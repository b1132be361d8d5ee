// SPDX-License-Identifier: MIT
// A fuzz case: an instance and the options for solving it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/solve.h"
#include "model/instance.h"
#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Limit imposed on a run.
enum class ImposedLimit : std::uint8_t {
  kNothing,    // only the deadline of run_case()
  kExpired,    // the deadline has passed before the run starts
  kSoon,       // the deadline is one millisecond after the start
  kMemory,     // the memory limit is only slightly above the memory in use
  kInterrupt,  // the interrupt flag is set before the run starts
};

// As text: a TinyInstance, optionally followed by "options" and any of the lines below it:
//
//     options
//     omega 0.01
//     policy free          (auto, fixed, free)
//     rtsp held-karp       (auto, held-karp, bounded-dp, cbc)
//     low-level forest     (own, visited-sets, single-legs, forest)
//     seed 7
//     threads 2
//     deterministic yes
//     without bypass       (a technique; repeatable)
//     node-memory 4000     (bytes)
//     tune bypasses=2      (a tunable; repeatable)
//     strike nothing       (nothing, expired, soon, memory, interrupt)
//     choices 5            (seed of with_random_choices())
struct FuzzCase {
  FuzzCase() { options.audit = true; }

  TinyInstance instance;
  SolveOptions options;
  ImposedLimit limit = ImposedLimit::kNothing;
  std::uint64_t choices = 0;  // seed of with_random_choices(); 0: no choices

  // The instance, with its choices.
  Instance build() const;
  std::string to_text() const;
  // Throws std::invalid_argument if `text` is malformed.
  static FuzzCase parse(std::string_view text);
};

// Returns a random instance with random options. The same seed gives the same case.
FuzzCase random_case(std::uint64_t seed);
// The same case with random choices, and without options that do not support them.
FuzzCase with_choices(FuzzCase fuzz_case, std::uint64_t seed);

}  // namespace grove::detail::fuzz
