// SPDX-License-Identifier: MIT
#include "batch/false_claims.h"

#include <fmt/format.h>

#include <map>
#include <string_view>
#include <utility>

namespace grove::detail::batch {
namespace {

using InstanceKey = std::pair<std::string, std::string>;  // id and digest of the instance

// The rows with the strongest results on an instance; nullptr if there is no such row.
struct BestResults {
  const Row* cheapest = nullptr;    // the cheapest plan that was re-checked
  const Row* highest = nullptr;     // the highest lower bound that Grove has proven
  const Row* infeasible = nullptr;  // a row in which Grove has proven that there is no plan
};

InstanceKey key_of(const Row& row) {
  return {row.run.instance, row.run.digest};
}

bool says_infeasible(const Row& row) {
  return row.outcome.status == to_string(Status::kInfeasible);
}

bool has_proof(const Row& row) {
  return row.solver.empty() && row.outcome.lower_bound;
}

std::map<InstanceKey, BestResults> best_results(std::span<const Row> rows) {
  std::map<InstanceKey, BestResults> all;
  for (const Row& row : rows) {
    BestResults& known = all[key_of(row)];
    const Outcome& outcome = row.outcome;
    if (outcome.cost && (!known.cheapest || *outcome.cost < *known.cheapest->outcome.cost))
      known.cheapest = &row;
    if (has_proof(row) &&
        (!known.highest || *outcome.lower_bound > *known.highest->outcome.lower_bound))
      known.highest = &row;
    if (says_infeasible(row)) known.infeasible = &row;
  }
  return all;
}

// Describes what contradicts the claimed cost; empty if nothing does.
std::string against_cost(const Row& row, const BestResults& known) {
  const Outcome& outcome = row.outcome;
  if (!outcome.claimed_cost) return "";
  const Cost claimed = *outcome.claimed_cost;
  if (outcome.cost)
    return claimed >= *outcome.cost ? ""
                                    : fmt::format("claims a cost of {}, but its own paths cost {}",
                                                  claimed, *outcome.cost);
  if (known.highest && claimed < *known.highest->outcome.lower_bound)
    return fmt::format("claims a cost of {}, but {} has proven that no plan costs less than {}",
                       claimed, known.highest->run.settings.method,
                       *known.highest->outcome.lower_bound);
  return "";
}

std::string against_bound(std::optional<Cost> bound, std::string_view verb,
                          const BestResults& known) {
  if (!bound || !known.cheapest || *bound <= *known.cheapest->outcome.cost) return "";
  return fmt::format("{} a lower bound of {}, but {} has a plan that costs {}", verb, *bound,
                     known.cheapest->run.settings.method, *known.cheapest->outcome.cost);
}

std::string against_plan(const Row& row, const BestResults& known) {
  if (row.outcome.status != kClaimed || !known.infeasible) return "";
  return fmt::format("claims a plan, but {} has proven that there is none",
                     known.infeasible->run.settings.method);
}

std::string against_infeasibility(const Row& row, const BestResults& known) {
  if (!says_infeasible(row) || !known.cheapest) return "";
  return fmt::format("proves that there is no plan, but {} has one that costs {}",
                     known.cheapest->run.settings.method, *known.cheapest->outcome.cost);
}

}  // namespace

std::vector<FalseClaim> false_claims(std::span<const Row> rows) {
  const auto all = best_results(rows);
  std::vector<FalseClaim> found;
  for (const Row& row : rows) {
    const BestResults& known = all.at(key_of(row));
    const auto proven = has_proof(row) ? row.outcome.lower_bound : std::nullopt;
    for (std::string what :
         {against_plan(row, known), against_infeasibility(row, known), against_cost(row, known),
          against_bound(row.outcome.claimed_lower_bound, "claims", known),
          against_bound(proven, "proves", known)})
      if (!what.empty())
        found.push_back({row.run.settings.method, row.run.instance, std::move(what)});
  }
  return found;
}

}  // namespace grove::detail::batch
