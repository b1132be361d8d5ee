// SPDX-License-Identifier: MIT
// Has an instance changed since it was solved?
#pragma once

#include <string>

#include "model/instance.h"

namespace grove::detail::batch {

// 64 bits in hexadecimal digits: fingerprint() and the ids of agents and tasks, which plans name.
// The same wherever the files are and however they are laid out. Tells a change; does not withstand
// forgery (FNV-1a).
std::string instance_digest(const Instance& instance);

}  // namespace grove::detail::batch
