// SPDX-License-Identifier: MIT
// Detects whether an instance has changed since it was solved.
#pragma once

#include <string>

#include "model/instance.h"

namespace grove::detail::batch {

// 64 bits as hexadecimal digits: a hash of fingerprint() and of the ids of agents and tasks, which
// plans refer to. It does not depend on the location and layout of the files. It detects changes
// but not deliberate collisions (FNV-1a).
std::string instance_digest(const Instance& instance);

}  // namespace grove::detail::batch
