// SPDX-License-Identifier: MIT
// Writes the formula of a core search to a certificate (docs/proof.md, "formula").
#pragma once

#include <filesystem>

#include "model/instance.h"
#include "model/omega.h"
#include "proof/certificate_file.h"

namespace grove::detail {

// Writes the formula that the proof log `part` contains, up to the first line at which it proves
// `bound` or more. First come all definitions, then all steps. Throws InputError.
void write_formula(const Instance& instance, const std::filesystem::path& part, Cost bound,
                   CertificateOutput& output);

}  // namespace grove::detail
