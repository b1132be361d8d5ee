// SPDX-License-Identifier: MIT
#include "engine/method.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "engine/adaptations.h"
#include "engine/choices.h"
#include "model/choices.h"

namespace grove::detail {
namespace {

struct Row {
  Method method;
  std::string_view name;
  LowLevel low_level = LowLevel::kOwn;
};

// Rows in the order of the enumerators.
constexpr Row kMethods[] = {
    {Method::kAuto, "auto"},
    {Method::kCtsCbsA, "cts-cbs-a"},
    {Method::kCtsCbsB, "cts-cbs-b"},
    {Method::kCtsCbsC, "cts-cbs-c"},
    {Method::kOptimalCbs, "optimal-cbs", LowLevel::kVisitedSets},
    {Method::kHcbs, "hcbs", LowLevel::kSingleLegs},
    {Method::kMgcbs, "mgcbs", LowLevel::kTimeIntervalForest},
    {Method::kSCbs, "s-cbs"},
    {Method::kCbsTa, "cbs-ta"},
    {Method::kCbsTs, "cbs-ts"},
};

const Row& row_of(Method method) {
  return kMethods[static_cast<std::size_t>(method)];
}

[[noreturn]] void refuse(Method method, std::string_view why) {
  throw std::invalid_argument(fmt::format("method {} {}", name_of(method), why));
}

bool is_composed(Method method) {
  return method == Method::kCtsCbsB || method == Method::kCtsCbsC;
}

bool assigns(Method method) {
  return method == Method::kCbsTa || method == Method::kCbsTs;
}

void set_options_for_assignments(Method method, SolveOptions& options) {
  if (options.policy == Policy::kFree)
    refuse(method, "searches one tree per assignment; expected policy fixed, or no policy");
  options.policy = Policy::kFixed;
  if (method != Method::kCbsTs) return;
  if (!is_built(RtspBackend::kCbc)) refuse(method, "requires a build with CBC");
  if (options.rtsp != RtspBackend::kAuto && options.rtsp != RtspBackend::kCbc)
    refuse(method, "solves integer programs; expected rtsp cbc, or no rtsp");
  options.rtsp = RtspBackend::kCbc;
}

}  // namespace

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const Row& row : kMethods) methods.push_back(row.method);
  return methods;
}

std::string_view name_of(Method method) {
  return row_of(method).name;
}

std::optional<Method> parse_method(std::string_view name) {
  const auto row = std::ranges::find(kMethods, name, &Row::name);
  return row == std::end(kMethods) ? std::nullopt : std::optional(row->method);
}

bool is_adaptation(Method method) {
  return method == Method::kCtsCbsA || method == Method::kCtsCbsB || method == Method::kCtsCbsC;
}

SolveOptions options_of(Method method, SolveOptions options) {
  options.low_level = row_of(method).low_level;
  const bool is_other = options.low_level != LowLevel::kOwn;
  if (is_other && options.policy == Policy::kFixed)
    refuse(method, "has one tree for all sequences; expected policy free, or no policy");
  if (method == Method::kSCbs) {
    if (options.policy == Policy::kFree)
      refuse(method,
             "searches the tree of one joint sequence; expected policy fixed, or no policy");
    options.policy = Policy::kFixed;
    options.omega = Omega::infinite();
  }
  if (assigns(method)) set_options_for_assignments(method, options);
  const bool keeps_state = !options.checkpoints.directory.empty() || options.resume != nullptr;
  if (keeps_state && (is_other || is_composed(method)))
    refuse(method, "does not support checkpoints; expected no checkpoint folder");
  return options;
}

// Throws std::invalid_argument if the instance has features that the published methods do not
// support.
void require_published_problem(Method method, const Instance& instance) {
  const auto& agents = instance.agents();
  if (instance.motion_world())
    refuse(method,
           "supports only agents that turn freely and tasks without a duration; expected another "
           "method");
  if (!instance.world().is_plain())
    refuse(method, "supports only two-way roads; expected another method");
  if (std::ranges::any_of(agents, &Agent::is_idle))
    refuse(method, "supports only agents with a goal or a task; expected another method");
  if (std::ranges::any_of(agents, [](const Agent& a) { return a.stops.size() < a.tasks.size(); }))
    refuse(method, "supports at most one task of an agent on a cell; expected another method");
}

void require_fit(Method method, const Instance& instance, const SolveOptions& options) {
  if (method != Method::kAuto && !assigns(method))
    require_no_choices(instance, fmt::format("method {} does not support", name_of(method)),
                       "method auto");
  require_choices_fit(instance, options);
  const auto ends_at_a_goal = [](const Agent& agent) { return agent.goal.has_value(); };
  if (is_adaptation(method) && std::ranges::all_of(instance.agents(), ends_at_a_goal))
    refuse(method,
           "requires an agent without a goal (MG-MAPF); expected another method (CTS-CBS itself is "
           "auto with policy fixed)");
  const bool is_published =
      options.low_level != LowLevel::kOwn || is_adaptation(method) || assigns(method);
  if (is_published) require_published_problem(method, instance);
  if (method == Method::kCbsTa && instance.task_count() > 0)
    refuse(method, "supports only instances without tasks; expected method cbs-ts");
  if (options.start && is_composed(method))
    refuse(method, "finds its own first plan; expected no start plan");
}

Solution solve_by(Method method, bool anytime, const Instance& instance,
                  const SolveOptions& options, const Limits& limits, RunObserver* observer) {
  require_fit(method, instance, options);
  RunObserver silent;
  RunObserver& watcher = observer ? *observer : silent;
  switch (method) {
    case Method::kCtsCbsB:
      return solve_with_destinations(instance, options, limits, watcher);
    case Method::kCtsCbsC:
      return anytime ? solve_with_destinations_first(instance, options, limits, watcher)
                     : solve_with_destinations_last(instance, options, limits, watcher);
    default:
      if (instance.has_choices()) return solve_with_choices(instance, options, limits, watcher);
      return solve(instance, options, limits, observer);
  }
}

}  // namespace grove::detail
