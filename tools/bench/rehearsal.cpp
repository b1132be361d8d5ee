// SPDX-License-Identifier: MIT
#include "tools/bench/rehearsal.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <system_error>

#include "grove/detail/io/input_error.h"
#include "tools/bench/child_process.h"
#include "tools/bench/judge.h"

namespace grove::detail::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kRefused = 2;
constexpr double kPatience_s = 60;  // to read an instance

class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "grove-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw InputError(name, "", "cannot be made: " + std::generic_category().message(errno));
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

// The last words of a run; that they begin with the instance goes without saying.
std::string reason(const fs::path& said, const std::string& instance) {
  std::string words = last_words(said);
  for (const std::string& told : {std::string(), instance})
    if (words.starts_with(told + ": ")) words.erase(0, told.size() + 2);
  return words;
}

}  // namespace

void rehearse(const std::vector<BenchInstance>& instances, std::vector<Method>& methods,
              const BenchOptions& options) {
  std::map<std::string, const BenchInstance*> first;  // of each problem
  for (const BenchInstance& instance : instances) first.emplace(instance.facts.problem, &instance);
  const Scratch scratch;
  for (Method& method : methods) {
    if (method.solver) continue;
    for (const auto& [problem, instance] : first) {
      const ChildEnd end =
          run_child(solve_command(options.program, instance->entry, method, 0, scratch / "plan"),
                    scratch / "said", {.seconds = kPatience_s, .cancelled = options.stopped});
      if (end.kind == ChildEnd::Kind::kExited && end.code == kRefused)
        method.unsuitable[problem] = reason(scratch / "said", instance->entry.path);
    }
    if (method.unsuitable.size() < first.size() || first.empty()) continue;
    const auto& [problem, why] = *method.unsuitable.begin();
    throw InputError(first[problem]->entry.path, "",
                     fmt::format("is not for the run '{}': {}", method.settings.method, why));
  }
}

}  // namespace grove::detail::bench
