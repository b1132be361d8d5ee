// SPDX-License-Identifier: MIT
// Cases in which a single component of the search must prove the whole bound.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/fuzz_case.h"

namespace grove::detail::fuzz {

enum class Part : std::uint8_t {
  kAny,        // all components and any options: random_case()
  kTree,       // branching and the bounds of single agents
  kPairs,      // kTree, and WDG weights of pairs and groups, by joint MDDs and by splits
  kGroups,     // kPairs, and EPEA* for pairs and groups, from the start
  kJoint,      // EPEA* for all agents
  kPrices,     // the Lagrangian bound at the root; the caller interrupts the tree search
  kCores,      // unsatisfiable cores
  kSequences,  // one tree for each joint sequence
  kChoices     // all assignments at once, for instances with choices
};

struct NamedPart {
  Part part;
  std::string_view name;
};
inline constexpr std::array kParts = {
    NamedPart{Part::kAny, "any"},         NamedPart{Part::kTree, "tree"},
    NamedPart{Part::kPairs, "pairs"},     NamedPart{Part::kGroups, "groups"},
    NamedPart{Part::kJoint, "joint"},     NamedPart{Part::kPrices, "prices"},
    NamedPart{Part::kCores, "cores"},     NamedPart{Part::kSequences, "sequences"},
    NamedPart{Part::kChoices, "choices"},
};

// Returns the case of `seed`: for kAny random_case(), for any other part a case without an imposed
// limit. With an even seed such a case has a board of its own, often larger than those of
// random_case(), and up to four agents.
FuzzCase component_case(Part part, std::uint64_t seed);

// Returns a valid plan that costs one step more than `plan`, as a start plan that the search has to
// improve. Returns `plan` itself if no single wait gives a valid plan.
Plan higher_cost_plan(const Instance& instance, const Plan& plan);

}  // namespace grove::detail::fuzz
