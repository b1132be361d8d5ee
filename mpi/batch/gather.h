// SPDX-License-Identifier: MIT
// All-gather among the ranks of a group, with polling.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mpi/transport.h"

namespace grove::detail::batch {

// Collective over `transport`: the text `mine` of each rank, by rank. Use it for an action that may
// fail on some ranks only (reading a file, say), before a collective action. Nothing else may be
// sent over `transport`. `wait` is called repeatedly until all ranks have called this.
std::vector<std::string> gather(Transport& transport, const std::string& mine,
                                const std::function<void()>& wait);

}  // namespace grove::detail::batch
