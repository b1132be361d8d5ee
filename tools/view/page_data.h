// SPDX-License-Identifier: MIT
// Instance and plans as data for the pages of `grove view` (README.md in this directory).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/plan_import.h"
#include "model/instance.h"

namespace grove::detail {

struct NamedPlan {
  std::string name;
  ClaimedPlan claimed;  // with or without a plan, valid or not
};

// Returns a JSON object without '<', so that it cannot end a <script> element.
std::string page_data(const std::string& instance_name, const Instance& instance,
                      std::span<const NamedPlan> plans);

}  // namespace grove::detail
