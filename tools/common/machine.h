// SPDX-License-Identifier: MIT
// What there is to work with.
#pragma once

#include <string>

#include "model/resources.h"

namespace grove::detail {

// See usable_memory().
double usable_memory_gb();
// What a run may use unless told otherwise: default_memory_limit(), in GB.
double default_memory_gb();
// Which cores this process may use; the same text, the same cores.
std::string usable_cores_text();
// "host Linux x86_64, 8 cores, 16.0 GB", and ", 4.0 GB of them granted" where that is less
std::string machine_text();
// "Intel(R) Xeon(R) CPU @ 2.20GHz, 8 cores": what results of several machines are told apart by.
std::string processor_text();

}  // namespace grove::detail
