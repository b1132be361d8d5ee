// SPDX-License-Identifier: MIT
#include "tools/solve/search_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

#include "primal/plan_source.h"

namespace grove::detail {
namespace {

class Counts {
 public:
  explicit Counts(const Stats& stats) : counts_(stats.counts) {}

  std::int64_t operator[](const std::string& name) const {
    const auto it = counts_.find(name);
    return it == counts_.end() ? 0 : it->second;
  }
  // Returns, for example, "8123 queries, 45 % cache hits".
  std::string queries(const std::string& what) const {
    const std::int64_t queries = (*this)[what + "_queries"];
    return fmt::format("{} queries, {} % cache hits", queries,
                       100 * (*this)[what + "_hits"] / std::max<std::int64_t>(queries, 1));
  }
  // Returns the number of splits of each kind in descending order, such as "vertex-edge 812, target
  // 44"; "none" without splits.
  std::string splits() const {
    constexpr std::string_view kPrefix = "splits_";
    std::vector<std::pair<std::int64_t, std::string>> kinds;
    for (auto it = counts_.lower_bound(std::string(kPrefix));
         it != counts_.end() && it->first.starts_with(kPrefix); ++it)
      kinds.emplace_back(it->second, it->first.substr(kPrefix.size()));
    std::ranges::stable_sort(kinds, std::greater(), &std::pair<std::int64_t, std::string>::first);
    std::string text;
    for (auto& [count, kind] : kinds) {
      std::ranges::replace(kind, '_', '-');
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", kind, count);
    }
    return text.empty() ? "none" : text;
  }
  // Returns the number of incumbents of each source and the total decrease of the cost by them,
  // such as "tree 1, prioritized 2 (cost -14)"; "none" without incumbents.
  std::string plans() const {
    std::string text;
    for (const std::string_view source : kPlanSources) {
      const std::int64_t plans = (*this)[fmt::format("plans_{}", source)];
      const std::int64_t gain = (*this)[fmt::format("gain_{}", source)];
      if (plans == 0) continue;
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", source, plans);
      if (gain > 0) text += fmt::format(" (cost -{})", gain);
    }
    return text.empty() ? "none" : text;
  }

 private:
  const std::map<std::string, std::int64_t>& counts_;
};

}  // namespace

std::vector<std::string> search_summary(const Stats& stats) {
  const Counts counts(stats);
  if (!stats.counts.contains("nodes_expanded")) return {};
  std::vector<std::string> lines{
      fmt::format("Nodes         expanded {}, generated {}, trees {}", counts["nodes_expanded"],
                  counts["nodes_generated"], counts["roots_generated"]),
      fmt::format("Splits        {}; {} bypasses", counts.splits(), counts["bypasses"]),
      fmt::format("Low level     {} calls, {} labels", counts["low_level_calls"],
                  counts["low_level_expanded"]),
      fmt::format("Branching     {}", counts.queries("branching_cost")),
      fmt::format("MDDs          {}", counts.queries("mdd")),
      fmt::format("WDG           {} nodes of joint MDDs, {} nodes of trees of pairs and groups",
                  counts["joint_mdd_nodes"], counts["pair_expansions"]),
      fmt::format("Primal        {} orders, {} LaCAM steps, {} LNS iterations; {} calls, {} labels",
                  counts["primal_attempts"], counts["primal_lacam_steps"],
                  counts["primal_lns_iterations"], counts["primal_low_level_calls"],
                  counts["primal_low_level_expanded"]),
      fmt::format("Incumbents    {}", counts.plans()),
  };
  if (counts["assignments"] > 0)
    lines.push_back(fmt::format("Choices       assignments searched one after the other: {}",
                                counts["assignments"]));
  if (counts["assignments"] > 0 || counts["cores"] > 0 || counts["cores_conflicts"] > 0)
    lines.push_back(
        fmt::format("Cores         {} cores, {} conflicts of the SAT solver, {} of paths",
                    counts["cores"], counts["cores_conflicts"], counts["cores_path_conflicts"]));
  return lines;
}

}  // namespace grove::detail
