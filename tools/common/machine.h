// SPDX-License-Identifier: MIT
// The cores, the memory and the name of this machine.
#pragma once

#include <string>

#include "model/resources.h"

namespace grove::detail {

// usable_memory() in GB.
double usable_memory_gb();
// default_memory_limit() in GB: the default of --memory-limit.
double default_memory_gb();
// Returns the cores that this process may use, as a text that is equal for equal sets of cores.
std::string usable_cores_text();
// "host Linux x86_64, 8 cores, 16.0 GB", and ", 4.0 GB of them granted" if a job limit is lower.
std::string machine_text();
// "Intel(R) Xeon(R) CPU @ 2.20GHz, 8 cores": identifies the machine in results.
std::string processor_text();

}  // namespace grove::detail
