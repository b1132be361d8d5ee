// SPDX-License-Identifier: MIT
// What there is to work with.
#pragma once

#include <string>

namespace grove::detail {

// The memory that this process may use: the machine's, or less where a container or a batch system
// grants no more.
double usable_memory_gb();
// The part of it that a run takes unless told otherwise: 80 %.
double default_memory_gb();
// The cores that this process may use.
int usable_cores();
// Which these are; the same text, the same cores.
std::string usable_cores_text();
// "host Linux x86_64, 8 cores, 16.0 GB", and ", 4.0 GB of them granted" where that is less
std::string machine_text();
// "Intel(R) Xeon(R) CPU @ 2.20GHz, 8 cores": what results of several machines are told apart by.
std::string processor_text();

}  // namespace grove::detail
