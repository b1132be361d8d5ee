// SPDX-License-Identifier: MIT
#include "grove/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "api/access.h"
#include "api/run.h"
#include "model/resources.h"

namespace grove {
namespace {

constexpr int kMaxThreads = 1024;

detail::Method method_of(const Options& options) {
  const std::optional<detail::Method> method = detail::parse_method(options.method);
  if (!method)
    throw InvalidArgument("/method", fmt::format("there is no method '{}'", options.method));
  return *method;
}

void require_numbers(const Options& options) {
  if (options.threads < 1 || options.threads > kMaxThreads)
    throw InvalidArgument(
        "/threads", fmt::format("found {}; expected from 1 to {}", options.threads, kMaxThreads));
  if (options.time_limit && !(*options.time_limit >= 0))
    throw InvalidArgument("/time_limit", "expected at least 0 seconds");
  if (!(options.progress_interval >= 0))
    throw InvalidArgument("/progress_interval", "expected at least 0 seconds");
  constexpr int kMaxWeight = detail::SolveOptions::kMaxVisitWeight;
  if (options.visit_weight < 0 || options.visit_weight > kMaxWeight)
    throw InvalidArgument("/visit_weight", fmt::format("found {}; expected from 0 to {}",
                                                       options.visit_weight, kMaxWeight));
}

}  // namespace

int default_threads() {
  return std::min(detail::usable_cores(), kMaxThreads);
}

// Rounded down to a multiple of 10 MB, because the command line shows it in that unit.
std::size_t default_memory_limit() {
  constexpr std::uint64_t kUnit = 10'000'000;
  static const std::uint64_t granted = detail::usable_memory();
  return static_cast<std::size_t>(std::max<std::uint64_t>(1, granted / 10 * 8 / kUnit) * kUnit);
}

detail::SolveOptions search_options_of(const detail::Instance& instance, const Options& options) {
  require_numbers(options);
  detail::SolveOptions made;
  made.omega = omega_of(options.omega);
  made.threads = options.threads;
  made.deterministic = options.deterministic;
  made.seed = options.seed;
  made.visit_weight = options.visit_weight;
  try {
    made = detail::options_of(method_of(options), made);
    if (options.start) made.start = valid_plan_of(instance, *options.start, "/start");
    detail::require_fit(method_of(options), instance, made);
  } catch (const std::invalid_argument& error) {
    throw InvalidArgument("/method", error.what());
  }
  return made;
}

Run::Run(const detail::Instance& instance, const Options& options)
    : stop_with_(options.stop, [this] { stop_ = true; }),
      observer_(instance, options, stop_, begin_) {
  limits_.watch_interrupt(&stop_);
  if (options.memory_limit) limits_.set_memory_limit(*options.memory_limit);
  // A time limit of 1e9 s or more counts as no limit, because the clock could overflow.
  if (options.time_limit && *options.time_limit < 1e9)
    limits_.set_deadline(begin_ + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(*options.time_limit)));
}

void Run::add_facts(detail::Solution& solution) const {
  solution.stats.measures["wall_s"] = std::chrono::duration<double>(Clock::now() - begin_).count();
}

Progress Run::Observer::to_public(const detail::Progress& progress) const {
  return {.seconds = std::chrono::duration<double>(Clock::now() - begin_).count(),
          .nodes_expanded = progress.nodes_expanded,
          .nodes_open = progress.nodes_open,
          .lower_bound = progress.lower_bound,
          .cost = progress.incumbent};
}

// Calls `function`, which calls a user's callback, unless a callback has thrown before. An
// exception of the callback must not pass through the search, so it is stored and ends the run.
template <class Function>
void Run::Observer::call(Function&& function) {
  if (failure) return;
  try {
    function();
  } catch (...) {
    failure = std::current_exception();
    stop_ = true;
  }
}

void Run::Observer::on_incumbent(const detail::Plan& plan, detail::PlanSource /*source*/,
                                 const detail::Progress& progress) {
  if (options_.on_incumbent)
    call([&] { options_.on_incumbent(public_plan(instance_, plan), to_public(progress)); });
}

void Run::Observer::on_event(detail::RunEvent event, const detail::Progress& progress) {
  if (!options_.on_progress) return;
  const Clock::time_point now = Clock::now();
  if (event != detail::RunEvent::kEnd && now < next_) return;
  next_ = now + std::chrono::duration_cast<Clock::duration>(
                    std::chrono::duration<double>(std::min(options_.progress_interval, 1e9)));
  call([&] { options_.on_progress(to_public(progress)); });
}

Solution solve(const Instance& instance, const Options& options) {
  const detail::Instance& inner = Access::instance(instance);
  const detail::SolveOptions search = search_options_of(inner, options);
  Run run(inner, options);
  return public_solution(
      inner, run([&](const detail::Limits& limits, detail::RunObserver& observer) {
        return with_public_exceptions([&] {
          return detail::solve_by(method_of(options), false, inner, search, limits, &observer);
        });
      }));
}

}  // namespace grove
