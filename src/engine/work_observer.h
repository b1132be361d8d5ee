// SPDX-License-Identifier: MIT
// Interface for events of node expansion.
#pragma once

#include <span>

#include "search/expander.h"
#include "search/node.h"

namespace grove::detail {

// Base class that does nothing. Thread-safe.
class WorkObserver {
 public:
  WorkObserver() = default;
  WorkObserver(const WorkObserver&) = delete;
  WorkObserver& operator=(const WorkObserver&) = delete;
  virtual ~WorkObserver() = default;

  // `worker` expanded a node, with this result.
  virtual void expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/, int /*worker*/) {}
  // These nodes were evicted.
  virtual void evicted(std::span<const NodePtr> /*nodes*/) {}
  // A work item was completed.
  virtual void worked() {}
};

}  // namespace grove::detail
