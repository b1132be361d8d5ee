// SPDX-License-Identifier: MIT
// Search techniques beyond plain CBS, each of which can be switched off.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace grove::detail {

// One technique. Techniques affect the running time but never the validity of a result. Policy
// `fixed` and the published low levels use none. Each technique is explained at the head of the
// file that implements it.
enum class Technique : std::uint8_t {
  kPrimal,           // prioritised planning and large neighbourhood search for incumbents
  kLacam,            // LaCAM for first plans on dense instances
  kStrongBranching,  // choose the split that raises the bounds of the children most
  kBypass,           // instead of splitting, use a path of equal cost with fewer conflicts
  kFewestConflicts,  // low level: of the cheapest paths, one with the fewest conflicts
  kTarget,           // split on the time from which an agent rests
  kCorridor,         // split on which of two agents passes a corridor first
  kWdg,              // WDG heuristic: bound from pairs that must cost more together
  kJointMdd,         // WDG: detect pairs that must cost more by comparing MDDs
  kCostSplits,       // split on which agent costs more, if two cannot both keep their costs
  kClusters,         // WDG: bounds of groups of three or more conflicting agents
  kEstimates,        // if w > 0 and there is no plan yet: take every second node by estimate
  kJointSearch,      // A* over joint states, if there are few agents and places
  kLagrangian,       // Lagrangian bound, if there are many agents
  kJointGroups,      // A* over joint states for pairs and groups that splits do not solve
  kLagrangianLns,    // LNS: the Lagrangian multipliers guide which paths to re-plan, and how
  kCores,            // bounds from unsatisfiable cores (SAT)
};

struct NamedTechnique {
  Technique technique;
  std::string_view name;  // on the command line: lower case, words joined by '-'
};

// All techniques.
inline constexpr std::array kTechniques = {
    NamedTechnique{Technique::kPrimal, "primal"},
    NamedTechnique{Technique::kLacam, "lacam"},
    NamedTechnique{Technique::kStrongBranching, "strong-branching"},
    NamedTechnique{Technique::kBypass, "bypass"},
    NamedTechnique{Technique::kFewestConflicts, "fewest-conflicts"},
    NamedTechnique{Technique::kTarget, "target"},
    NamedTechnique{Technique::kCorridor, "corridor"},
    NamedTechnique{Technique::kWdg, "wdg"},
    NamedTechnique{Technique::kJointMdd, "joint-mdd"},
    NamedTechnique{Technique::kCostSplits, "cost-splits"},
    NamedTechnique{Technique::kClusters, "clusters"},
    NamedTechnique{Technique::kEstimates, "estimates"},
    NamedTechnique{Technique::kJointSearch, "joint-search"},
    NamedTechnique{Technique::kLagrangian, "lagrangian"},
    NamedTechnique{Technique::kJointGroups, "joint-groups"},
    NamedTechnique{Technique::kLagrangianLns, "lagrangian-lns"},
    NamedTechnique{Technique::kCores, "cores"},
};

// Names of removed techniques. The option parser reports them as removed.
inline constexpr std::array<std::string_view, 1> kRemovedTechniques = {"sequence-splits"};

// A set of techniques.
class Techniques {
 public:
  Techniques() = default;  // empty
  Techniques(std::initializer_list<Technique> techniques) {
    for (Technique t : techniques) bits_ |= bit(t);
  }
  // All techniques: the default of a run.
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
// Returns nullopt if no technique has this name. Until version 0.2 it also accepts the deprecated
// names from before version 0.1, such as "configurations".
std::optional<Technique> parse_technique(std::string_view name);

}  // namespace grove::detail
