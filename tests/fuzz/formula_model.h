// SPDX-License-Identifier: MIT
// Tests that the clauses of a formula (docs/proof.md) are true for a plan.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail::fuzz {

// Returns the definitions of a formula with a theorem that a plan of cost `cost` refutes; empty if
// the certificate has no formula.
std::vector<std::string> definitions_only(std::span<const std::string> certificate, Cost cost);

// `clauses`: a file in DIMACS format, written by grove-verify for `definitions`. Returns whether an
// assignment satisfies them in which presences, constraints and used goals have the values of the
// plan.
bool has_model(const std::filesystem::path& clauses, std::span<const std::string> definitions,
               const Instance& instance, const Plan& plan);

}  // namespace grove::detail::fuzz
