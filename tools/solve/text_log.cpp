// SPDX-License-Identifier: MIT
#include "tools/solve/text_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "tools/common/gap_text.h"
#include "tools/common/machine.h"
#include "tools/common/version.h"
#include "tools/solve/assignment_summary.h"
#include "tools/solve/search_summary.h"

namespace grove::detail {
namespace {

constexpr int kRowsPerHeader = 20;

std::string count_text(int count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// Returns the number of items with each trait, such as " (2 turning, 1 idle)"; "" if no item has a
// trait.
template <class Item>
std::string traits_text(
    std::span<const Item> items,
    std::initializer_list<std::pair<bool (*)(const Item&), std::string_view>> traits) {
  std::string text;
  for (const auto& [holds, name] : traits)
    if (const auto count = std::ranges::count_if(items, holds); count > 0)
      text += fmt::format("{}{} {}", text.empty() ? " (" : ", ", count, name);
  return text.empty() ? text : text + ")";
}

std::string agents_text(const Instance& instance) {
  return count_text(instance.agent_count(), "agent") +
         traits_text<Agent>(
             instance.agents(),
             {{[](const Agent& a) { return a.motion.turn_steps > 0; }, "turning"},
              {[](const Agent& a) { return !a.has_destination() && !a.is_idle(); },
               "without a goal"},
              {[](const Agent& a) { return !a.goals.empty(); }, "with a choice of goals"},
              {[](const Agent& a) { return a.is_idle() && a.options.empty(); },
               "with nothing to do"}});
}

std::string tasks_text(const Instance& instance) {
  return count_text(instance.task_count(), "task") +
         traits_text<Task>(
             instance.tasks(),
             {{[](const Task& t) { return t.duration > 0; }, "taking time"},
              {[](const Task& t) { return !t.needs_all(); }, "with a choice of agents"}});
}

std::string cost_text(std::optional<Cost> cost) {
  return cost ? fmt::format("{}", *cost) : "-";
}

char letter_of(PlanSource source) {
  switch (source) {
    case PlanSource::kStart:
      return 'S';
    case PlanSource::kPrioritizedPlanning:
      return 'H';
    case PlanSource::kLacam:
      return 'C';
    case PlanSource::kLns:
      return 'L';
    case PlanSource::kJointSearch:
      return 'J';
    case PlanSource::kCores:
      return 'U';
    case PlanSource::kTree:
      break;
  }
  return '*';
}

char letter_of(const LogRow& row) {
  switch (row.event) {
    case RunEvent::kIncumbent:
      return letter_of(row.source);
    case RunEvent::kBound:
      return 'B';
    case RunEvent::kTree:
      return 'T';
    case RunEvent::kProgress:
    case RunEvent::kEnd:
      break;
  }
  return ' ';
}

// Returns the number of evicted nodes and of restarts; "" if no node was evicted.
std::string evicted_text(const Solution& solution) {
  const auto evicted = solution.stats.counts.find("nodes_evicted");
  if (evicted == solution.stats.counts.end() || evicted->second == 0) return "";
  const std::int64_t restarts = solution.stats.counts.at("restarts");
  return fmt::format(", {} nodes evicted{}", evicted->second,
                     restarts == 0 ? "" : fmt::format(", {} restarts", restarts));
}

std::string map_text(const Instance& instance) {
  if (const Roadmap* roadmap = instance.roadmap())
    return fmt::format("{} vertices, {}, {} places", roadmap->vertices().size(),
                       count_text(static_cast<int>(roadmap->roads().size()), "road"),
                       roadmap->place_count());
  const Grid& grid = instance.grid();
  return fmt::format("{} x {}, {} passable cells", grid.width(), grid.height(),
                     grid.passable_count());
}

}  // namespace

void TextLog::head(const LogHead& h) {
  const Instance& instance = h.loaded.instance;
  instance_ = &instance;
  sink_.line(fmt::format("{} on {}", version_text(), machine_text()));
  sink_.line(fmt::format("Instance      {}: {}, {}", h.instance, agents_text(instance),
                         tasks_text(instance)));
  sink_.line(fmt::format("{:<14}{}: {}", instance.is_on_grid() ? "Map" : "Roadmap",
                         h.loaded.map_path.string(), map_text(instance)));
  sink_.line(fmt::format("Options       {}", h.options.empty() ? "all defaults" : h.options));
  if (!h.method.empty()) sink_.line(fmt::format("Method        {}", h.method));
  sink_.line(
      fmt::format("Threads       {}{}", h.workers, h.deterministic ? ", deterministic" : ""));
  sink_.line();
  sink_.line(
      "First column: source of a new incumbent (* tree search, H prioritised planning, C LaCAM,");
  sink_.line(
      "L large neighbourhood search, J joint search, U unsatisfiable cores, S start plan); else B "
      "if");
  sink_.line(
      "the lower bound rose; else T for a new tree. expanded, open: constraint-tree nodes "
      "expanded");
  sink_.line("and still open.");
  sink_.line("lower bound: no plan costs less. incumbent: cost of the best plan so far.");
  sink_.line("gap = (incumbent - lower bound) / lower bound, directly comparable with omega.");
  sink_.line();
}

void TextLog::warning(std::string_view text) {
  sink_.line(fmt::format("Warning: {}", text));
}

void TextLog::resumed(const CheckpointHeader& checkpoint) {
  const auto expanded = checkpoint.counters.find("nodes_expanded");
  sink_.line(fmt::format(
      "Resuming from a checkpoint after {:.1f} s and {} nodes: lower bound {}{}",
      checkpoint.seconds, expanded == checkpoint.counters.end() ? 0 : expanded->second,
      checkpoint.lower_bound,
      checkpoint.incumbent ? fmt::format(", incumbent {}", checkpoint.incumbent->cost) : ""));
  sink_.line();
}

void TextLog::row(const LogRow& row) {
  if (rows_++ % kRowsPerHeader == 0)
    sink_.line(
        "     expanded       open    trees   lower bound     incumbent       gap    memory      "
        "time");
  const Progress& p = row.progress;
  sink_.line(fmt::format("{:1} {:>11} {:>10} {:>8} {:>13} {:>13} {:>9} {:>6} MB {:>8.2f}s",
                         letter_of(row), p.nodes_expanded, p.nodes_open, p.trees, p.lower_bound,
                         cost_text(p.incumbent), gap_text(p.incumbent, p.lower_bound),
                         row.memory_bytes / 1'000'000, row.seconds));
}

void TextLog::progress(const LogRow& row) {
  if (!sink_.shows_progress()) return;
  const Progress& p = row.progress;
  sink_.progress(
      fmt::format("  {:.1f} of {:g} s: nodes {}, trees {}, lower bound {}, incumbent {}, gap {}",
                  row.seconds, time_limit_s_, p.nodes_expanded, p.trees, p.lower_bound,
                  cost_text(p.incumbent), gap_text(p.incumbent, p.lower_bound)));
}

void TextLog::infeasible(std::string_view reason) {
  sink_.line(fmt::format("There is no plan: {}.", reason));
}

void TextLog::note(std::string_view text, double seconds) {
  sink_.line(fmt::format("  {} ({:.2f}s)", text, seconds));
}

void TextLog::checkpoint(const CheckpointReport& report, double seconds) {
  if (report.failure.empty())
    return sink_.line(fmt::format("  Checkpoint of {} nodes written in {:.2f} s ({:.2f}s)",
                                  report.nodes, report.seconds, seconds));
  const std::string text = fmt::format("Checkpoint failed: {}", report.failure);
  sink_.line("  " + text);
  sink_.warn_if_log_hidden(text);
}

void TextLog::end(const LogEnd& end) {
  const Solution& solution = end.solution;
  const auto text = [&](const char* key) {
    const auto it = solution.stats.texts.find(key);
    return it == solution.stats.texts.end() ? std::string() : it->second;
  };
  const auto cost = solution.plan ? std::optional(solution.plan->cost) : std::nullopt;
  const std::string stopped = text("stopped_by");

  sink_.line();
  sink_.line(fmt::format("Status        {}{}", to_string(solution.status),
                         stopped.empty() ? "" : fmt::format(" (stopped by: {})", stopped)));
  if (cost) sink_.line(fmt::format("Cost          {}", *cost));
  if (solution.status != Status::kInfeasible)
    sink_.line(fmt::format("Lower bound   {}", solution.lower_bound));
  if (cost)
    sink_.line(fmt::format("Gap           {} (omega asks for {})",
                           gap_text(cost, solution.lower_bound),
                           solution.omega.is_infinite()
                               ? "any plan"
                               : fmt::format("at most {:g} %", 100 * solution.omega.value())));
  if (const std::string remark = text("remark"); !remark.empty())
    sink_.line("Remark        " + remark);
  if (const std::string proof = text("proof"); !proof.empty())
    sink_.line(fmt::format("Proof file    {}: {}", end.proof_file, proof));
  sink_.line(fmt::format("Time          {:.2f} s", solution.stats.measures.at("wall_s")));
  const auto node_bytes = solution.stats.measures.find("node_bytes");
  if (node_bytes != solution.stats.measures.end())
    sink_.line(fmt::format("Memory        {:.0f} MB at most, {:.0f} bytes per node{}",
                           solution.stats.measures.at("peak_memory_mb"), node_bytes->second,
                           evicted_text(solution)));
  if (verbose_)
    for (const std::string& line : search_summary(solution.stats)) sink_.line(line);
  if (instance_ && solution.plan)
    for (const std::string& line : assignment_summary(*instance_, *solution.plan)) sink_.line(line);
  if (end.is_unwritten)
    return sink_.line(fmt::format("Plan file     {} was not written", end.plan_file));
  sink_.line(fmt::format(
      "Plan file     {}{}", end.plan_file,
      end.kept ? fmt::format(" (kept as it is, with a valid plan of cost {})", *end.kept) : ""));
}

}  // namespace grove::detail
