// SPDX-License-Identifier: MIT
// Cases in which one part of the search has to prove all that is proven.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/fuzz_case.h"

namespace grove::detail::fuzz {

enum class Part : std::uint8_t {
  kAny,       // all of them and any options: random_case()
  kTree,      // splits and single agents
  kPairs,     // and what pairs and groups cost more, by their paths and by splits
  kGroups,    // and joint search of pairs and groups, at once
  kJoint,     // joint search of all agents
  kPrices,    // the prices at the root; the tree stops soon
  kSequences  // one tree for each joint sequence
};

struct NamedPart {
  Part part;
  std::string_view name;
};
inline constexpr std::array kParts = {
    NamedPart{Part::kAny, "any"},
    NamedPart{Part::kTree, "tree"},
    NamedPart{Part::kPairs, "pairs"},
    NamedPart{Part::kGroups, "groups"},
    NamedPart{Part::kJoint, "joint"},
    NamedPart{Part::kPrices, "prices"},
    NamedPart{Part::kSequences, "sequences"},
};

// The same seed makes the same case. Half of them are on larger boards than those of
// random_case(), with up to four agents.
FuzzCase component_case(Part part, std::uint64_t seed);

// A plan that costs a little more, by one step where that can be: what the search knows from the
// beginning, and has to beat. The plan itself if no agent can wait.
Plan dearer(const Instance& instance, const Plan& plan);

}  // namespace grove::detail::fuzz
