// SPDX-License-Identifier: MIT
#include "tools/bench/run_outcome.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "io/input_error.h"
#include "io/plan_file.h"
#include "io/text_file.h"
#include "tools/common/commands.h"

namespace grove::detail::bench {
namespace {

constexpr std::string_view kErrorMark = "grove: error: ";

std::string why_failed(const ChildEnd& end, const std::filesystem::path& output_file) {
  switch (end.kind) {
    case ChildEnd::Kind::kExited:
      if (end.code == 0) return "";
      return fmt::format("ended with exit code {}{}", end.code, last_output_line(output_file));
    case ChildEnd::Kind::kSignalled:
      return fmt::format("ended by signal {} ({})", end.code, ::strsignal(end.code));
    case ChildEnd::Kind::kTooLong:
      return fmt::format("did not end; killed after {:.0f} s", end.wall_s);
    case ChildEnd::Kind::kCancelled:
      return "interrupt";
  }
  return "";
}

}  // namespace

std::string last_output_line(const std::filesystem::path& output_file) {
  try {
    const std::string text = read_text(output_file);
    const auto lines = split_lines(text);
    if (lines.empty()) return "";
    std::string_view last = lines.back();
    if (last.starts_with(kErrorMark)) last.remove_prefix(kErrorMark.size());
    return ": " + one_line(last);
  } catch (const InputError&) {
    return "";
  }
}

bool is_refusal(const ChildEnd& end) {
  return end.kind == ChildEnd::Kind::kExited && end.code == kExitBadInput;
}

std::string refusal(const std::filesystem::path& output_file, const std::string& instance) {
  std::string words = last_output_line(output_file);
  for (const std::string& prefix : {std::string(), instance})
    if (words.starts_with(prefix + ": ")) words.erase(0, prefix.size() + 2);
  return words;
}

bool check_claims(batch::Outcome& outcome, const ChildEnd& end,
                  const std::filesystem::path& output_file) {
  constexpr std::string_view kCost = "verified: no plan costs less than ";
  std::string why = end.kind == ChildEnd::Kind::kTooLong ? "takes too long" : "is not verified";
  if (end.kind == ChildEnd::Kind::kExited && end.code == 0) {
    const std::string text = read_text(output_file);
    if (text.starts_with("verified: there is no plan")) return true;
    if (text.starts_with(kCost)) {
      const Cost cost = std::atoll(text.c_str() + kCost.size());
      if (outcome.status != to_string(Status::kInfeasible) && cost >= outcome.lower_bound)
        return true;
      why = fmt::format("proves no more than {}", cost);
    }
  } else {
    why += last_output_line(output_file);
  }
  if (outcome.error.empty()) outcome.error = "the certificate " + why;
  return false;
}

std::vector<batch::TracePoint> trace_of_log(const std::filesystem::path& log) {
  std::vector<batch::TracePoint> trace;
  std::error_code error;
  if (!std::filesystem::is_regular_file(log, error)) return trace;
  const std::string text = read_text(log);
  for (const std::string_view line : split_lines(text)) {
    const auto row = nlohmann::json::parse(line, nullptr, false);
    if (!row.is_object() || row.value("event", "") != "incumbent") continue;
    trace.push_back({.seconds = row.value("time_s", 0.0),
                     .cost = row.value("incumbent", Cost{0}),
                     .lower_bound = row.value("lower_bound", Cost{0})});
  }
  batch::thin_out(trace, kMaxTracePoints);
  return trace;
}

batch::Outcome outcome_of_run(const ChildEnd& end, double time_limit_s, const Instance& instance,
                              const std::filesystem::path& plan_file,
                              const std::filesystem::path& output_file) {
  batch::Outcome outcome;
  outcome.error = why_failed(end, output_file);
  if (!outcome.error.empty()) return outcome;
  try {
    outcome = batch::outcome_of(instance, read_solution(plan_file, instance));
    if (outcome.solved && end.wall_s > time_limit_s) {
      outcome.solved = false;
      outcome.error = kTimeLimit;
    }
    return outcome;
  } catch (const InputError& error) {
    outcome.error = fmt::format("the plan file is wrong: {}", error.what());
    return outcome;
  }
}

}  // namespace grove::detail::bench
