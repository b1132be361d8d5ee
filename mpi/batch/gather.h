// SPDX-License-Identifier: MIT
// How the ranks of a group come to know what each of them found.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mpi/transport.h"

namespace grove::detail::batch {

// All ranks of `transport`: what each of them says, by rank. For what may fail on some of them only
// (reading a file, say) before they do something that none can do alone. Nothing else may go over
// `transport`; `wait` is called again and again until all have spoken.
std::vector<std::string> gather(Transport& transport, const std::string& mine,
                                const std::function<void()>& wait);

}  // namespace grove::detail::batch
