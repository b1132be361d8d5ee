// SPDX-License-Identifier: MIT
// What a page of `grove view` shows, as the data that its program reads (README.md beside this).
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

// One JSON object. No part of it ends a <script> element.
std::string page_data(const std::string& instance_name, const Instance& instance,
                      std::span<const NamedPlan> plans);

}  // namespace grove::detail
