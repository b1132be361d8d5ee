// SPDX-License-Identifier: MIT
// Properties of this machine: cores, memory, name, processor.
#pragma once

#include <string>

#include "model/resources.h"

namespace grove::detail {

// Returns usable_memory() in GB (1e9 bytes).
double usable_memory_gb();
// Returns default_memory_limit() in GB (1e9 bytes), the default of --memory-limit.
double default_memory_gb();
// Returns the numbers of the cores on which this process may run, or "unknown" if the system does
// not report them. Other equal texts mean equal sets of cores.
std::string usable_cores_text();
// Returns "host Linux x86_64, 8 cores, 16.0 GB", followed by ", 4.0 GB of them granted" if a job
// limit is lower than the physical memory.
std::string machine_text();
// Returns the processor model and the number of cores, which identify the machine in results:
// "Intel(R) Xeon(R) CPU @ 2.20GHz, 8 cores".
std::string processor_text();

}  // namespace grove::detail
