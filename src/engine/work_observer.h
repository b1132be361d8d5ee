// SPDX-License-Identifier: MIT
// What those who expand nodes tell of it.
#pragma once

#include <span>

#include "search/expander.h"
#include "search/node.h"

namespace grove::detail {

// Hears of it and does nothing; those who want to know override. Methods may be called from any
// thread.
class WorkObserver {
 public:
  WorkObserver() = default;
  WorkObserver(const WorkObserver&) = delete;
  WorkObserver& operator=(const WorkObserver&) = delete;
  virtual ~WorkObserver() = default;

  // A node led to this, in the hands of the worker of this number.
  virtual void expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/, int /*worker*/) {}
  // These were given up.
  virtual void evicted(std::span<const NodePtr> /*nodes*/) {}
  // Some work was done.
  virtual void worked() {}
};

}  // namespace grove::detail
