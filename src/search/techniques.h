// SPDX-License-Identifier: MIT
// Search techniques beyond plain CBS; each can be switched off.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace grove::detail {

// One technique. None changes what is proven, only the running time. The policy `fixed` uses none.
// Each is explained at the head of the file that implements it.
enum class Technique : std::uint8_t {
  kPrimal,           // prioritised planning and large neighbourhood search for incumbents
  kLacam,            // LaCAM for first plans on dense instances
  kStrongBranching,  // split on the conflict that raises the bounds most
  kBypass,           // instead of splitting, take a path of equal cost with fewer conflicts
  kFewestConflicts,  // low level: among paths of equal cost, the fewest conflicts
  kTarget,           // split on the time from which an agent rests
  kCorridor,         // split on which of two agents passes a corridor first
  kWdg,              // WDG: bound from pairs of agents that cannot both have their best paths
  kJointMdd,         // find such pairs by their MDDs, without a search
  kCostSplits,       // split on which of two such agents costs more
  kClusters,         // the same for groups that conflict although no pair of them must cost more
  kEstimates,        // w > 0 and no plan yet: every second node by estimated cost
  kJointSearch,      // A* over joint states, if there are few agents and places
  kLagrangian,       // Lagrangian bound, if there are many agents
  kJointGroups,      // A* over joint states of pairs and groups that splits do not solve
  kLagrangianLns,    // LNS: the Lagrangian multipliers choose which paths to re-plan, and where to
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
};

// Former techniques. The options report that they were removed.
inline constexpr std::array<std::string_view, 1> kRemovedTechniques = {"sequence-splits"};

// A set of techniques; a value.
class Techniques {
 public:
  Techniques() = default;  // none
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
// Also accepts the deprecated names of before 0.1 ("configurations", ...), until 0.2.
std::optional<Technique> parse_technique(std::string_view name);

}  // namespace grove::detail
