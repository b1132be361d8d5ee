// SPDX-License-Identifier: MIT
// What the search may use beyond plain CBS, each of which can be switched off.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace grove::detail {

// One technique. None changes what is proven, only how fast; the policy `fixed` uses none. Each is
// explained at the head of the file that does it.
enum class Technique : std::uint8_t {
  kPrimal,           // prioritised planning and large neighbourhood search for incumbents
  kConfigurations,   // LaCAM for first plans on crowded maps
  kStrongBranching,  // of several conflicts, split the one that raises the bounds most
  kBypass,           // take an equally cheap path with fewer conflicts instead of splitting
  kFewestConflicts,  // of equally cheap paths take one with the fewest conflicts
  kTarget,           // split on when an agent comes to rest
  kTraversal,        // split on which of two agents passes a corridor
  kSequenceSplits,  // split on an agent's next stop, where no conflict raises both sides; not usual
  kDependencies,    // bound from pairs of agents that cannot both have their best paths
  kJointPaths,      // see such pairs in their optimal paths, without a search
  kCostSplits,      // split on which of two such agents costs more
  kClusters,        // the same for groups that conflict though no pair of them must cost more
  kEstimates,       // with w > 0, while there is no plan: every other node by what it promises
  kJointSearch,     // beside the tree A* over joint states, where there are few agents and places
  kLagrangian,      // beside the tree a bound from prices, where there are many agents
  kJointGroups,     // A* over joint states of pairs and groups that splits do not settle
  kPricedPlans,     // what is dear by that bound says which paths to plan anew, and where to
};

struct NamedTechnique {
  Technique technique;
  std::string_view name;  // on the command line: lower case, words joined by '-'
};

// All of them.
inline constexpr std::array kTechniques = {
    NamedTechnique{Technique::kPrimal, "primal"},
    NamedTechnique{Technique::kConfigurations, "configurations"},
    NamedTechnique{Technique::kStrongBranching, "strong-branching"},
    NamedTechnique{Technique::kBypass, "bypass"},
    NamedTechnique{Technique::kFewestConflicts, "fewest-conflicts"},
    NamedTechnique{Technique::kTarget, "target"},
    NamedTechnique{Technique::kTraversal, "traversal"},
    NamedTechnique{Technique::kSequenceSplits, "sequence-splits"},
    NamedTechnique{Technique::kDependencies, "dependencies"},
    NamedTechnique{Technique::kJointPaths, "joint-paths"},
    NamedTechnique{Technique::kCostSplits, "cost-splits"},
    NamedTechnique{Technique::kClusters, "clusters"},
    NamedTechnique{Technique::kEstimates, "estimates"},
    NamedTechnique{Technique::kJointSearch, "joint-search"},
    NamedTechnique{Technique::kLagrangian, "lagrangian"},
    NamedTechnique{Technique::kJointGroups, "joint-groups"},
    NamedTechnique{Technique::kPricedPlans, "priced-plans"},
};

// A set of techniques; a value.
class Techniques {
 public:
  Techniques() = default;  // none
  Techniques(std::initializer_list<Technique> techniques) {
    for (Technique t : techniques) bits_ |= bit(t);
  }
  static Techniques all();
  // What a run uses unless told otherwise: all that paid when it was measured.
  static Techniques defaults();

  bool has(Technique t) const { return (bits_ & bit(t)) != 0; }
  Techniques with(Technique t) const { return Techniques(bits_ | bit(t)); }
  Techniques without(Technique t) const { return Techniques(bits_ & ~bit(t)); }
  Techniques without(Techniques others) const { return Techniques(bits_ & ~others.bits_); }
  friend bool operator==(Techniques, Techniques) = default;

 private:
  explicit Techniques(std::uint32_t bits) : bits_(bits) {}
  static std::uint32_t bit(Technique t) { return std::uint32_t{1} << static_cast<unsigned>(t); }
  std::uint32_t bits_ = 0;
};

std::string_view name_of(Technique technique);
std::optional<Technique> parse_technique(std::string_view name);

}  // namespace grove::detail
