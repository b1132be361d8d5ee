// SPDX-License-Identifier: MIT
#include "tools/common/version.h"

#include "git_hash.h"

namespace grove::detail {

std::string version_text() {
  return "grove " GROVE_VERSION " (git " GROVE_GIT_HASH ")";
}

}  // namespace grove::detail
