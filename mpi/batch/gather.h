// SPDX-License-Identifier: MIT
// All-gather among the ranks of a group, with a callback while it waits.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mpi/transport.h"

namespace grove::detail::batch {

// Collective over `transport`. Returns the argument `mine` of each rank, by rank. Serves to report,
// before a collective action, that an earlier action (such as reading a file) failed on some ranks.
// Nothing else may be in transit on `transport`. Calls `wait` repeatedly until all ranks have
// called this function.
std::vector<std::string> gather(Transport& transport, const std::string& mine,
                                const std::function<void()>& wait);

}  // namespace grove::detail::batch
