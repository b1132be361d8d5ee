// SPDX-License-Identifier: MIT
#include "io/input_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "io/input_error.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& folder, const fs::path& path) {
  const auto [end, at] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end() && at != path.end();
}

}  // namespace

void require_memory(const InputRules& rules, std::string_view file, std::string_view place,
                    std::int64_t count, std::string_view what, std::size_t bytes_each) {
  const double need = static_cast<double>(count) * static_cast<double>(bytes_each);
  if (need <= static_cast<double>(std::max(rules.memory, kAlwaysGranted))) return;
  throw InputError(file, place,
                   fmt::format("{} {} need about {:.2g} GB of memory; expected at most {:.2g} GB, "
                               "the memory limit",
                               count, what, need / 1e9, static_cast<double>(rules.memory) / 1e9));
}

fs::path file_in_folder(const InputRules& rules, const fs::path& folder, const fs::path& name) {
  const fs::path path = (folder / name).lexically_normal();
  if (!rules.confined) return path;
  const auto refuse = [&](std::string_view what) {
    throw std::invalid_argument(
        fmt::format("'{}' {}; expected a file in the folder of this file or below, with --confine",
                    one_line(name.string()), what));
  };
  if (name.is_absolute()) refuse("is an absolute path");
  std::error_code error;
  const fs::path base = fs::canonical(folder.empty() ? "." : folder, error);
  // weakly_canonical() also accepts a file that does not exist. The reader reports later that it is
  // missing.
  const fs::path real = error ? fs::path() : fs::weakly_canonical(base / name, error);
  if (error || !is_below(base, real)) refuse("leads outside the folder of this file");
  return real;
}

}  // namespace grove::detail
