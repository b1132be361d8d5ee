// SPDX-License-Identifier: MIT
#include "tools/bench/method_support.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <system_error>

#include "io/input_error.h"
#include "tools/bench/child_process.h"
#include "tools/bench/run_outcome.h"

namespace grove::detail::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kDryRunLimit_s = 60;  // limit of a dry run, which only reads the instance

// A temporary folder, deleted by the destructor.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "grove-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw InputError(name, "", "cannot be created: " + std::generic_category().message(errno));
    folder_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path operator/(const char* name) const { return folder_ / name; }

 private:
  fs::path folder_;
};

}  // namespace

void check_method_support(const std::vector<BenchInstance>& instances,
                          const std::vector<Method>& methods, const BenchOptions& options) {
  std::map<std::string, const BenchInstance*> first;  // first instance of each kind
  for (const BenchInstance& instance : instances)
    if (instance.error.empty()) first.emplace(instance.kind, &instance);
  const Scratch scratch;
  for (const Method& method : methods) {
    if (method.solver) continue;
    const BenchInstance* refused = nullptr;
    std::string why;
    for (const auto& [kind, instance] : first) {
      const ChildEnd end = run_child(
          solve_command(options.program, instance->entry, method, 0, scratch / "plan"),
          scratch / "output_file", {.seconds = kDryRunLimit_s, .cancelled = options.stopped});
      if (!is_refusal(end)) {
        refused = nullptr;
        break;
      }
      if (refused == nullptr) {
        refused = instance;
        why = refusal(scratch / "output_file", instance->entry.path);
      }
    }
    if (refused != nullptr)
      throw InputError(refused->entry.path, "",
                       fmt::format("the method of run '{}' does not accept it: {}",
                                   method.settings.method, why));
  }
}

}  // namespace grove::detail::bench
