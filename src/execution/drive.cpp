// SPDX-License-Identifier: MIT
#include "grove/execution/drive.h"

#include <algorithm>

namespace grove {
namespace {

double end_of(const Drive& drive, ActionIndex action) {
  return action == kNoAction ? 0 : drive.end[action];
}

double may_begin(const PassingOrder& order, const Drive& drive, ActionIndex action) {
  return std::max(end_of(drive, order.before(action)), end_of(drive, order.after(action)));
}

// Of a ring everybody waits for whoever comes last.
AgentIndex waits_for(const PassingOrder& order, const Drive& drive, std::int32_t step) {
  for (const ActionIndex a : order.step(step)) {
    const AgentIndex self = order.actions()[a].agent;
    if (drive.begin[a] < kNeverDone && drive.end[a] == kNeverDone) return self;
    const ActionIndex other = order.after(a);
    if (other != kNoAction && drive.end[other] == kNeverDone) return order.actions()[other].agent;
    if (end_of(drive, order.before(a)) == kNeverDone) return self;
  }
  return -1;
}

}  // namespace

Drive drive(const PassingOrder& order, const Duration& duration) {
  Drive drive{std::vector<double>(order.actions().size(), kNeverDone),
              std::vector<double>(order.actions().size(), kNeverDone)};
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    double begin = 0;
    for (const ActionIndex a : order.step(number))
      begin = std::max(begin, may_begin(order, drive, a));
    if (begin == kNeverDone) continue;
    double end = begin;
    for (const ActionIndex a : order.step(number)) end = std::max(end, begin + duration(a, begin));
    for (const ActionIndex a : order.step(number)) {
      drive.begin[a] = begin;
      drive.end[a] = end;
    }
  }
  return drive;
}

Drive drive_undisturbed(const PassingOrder& order) {
  return drive(order, [&](ActionIndex a, double) { return double{1} * order.actions()[a].steps; });
}

std::vector<Stuck> stuck(const PassingOrder& order, const Drive& drive) {
  std::vector<Stuck> stuck;
  std::vector<bool> is_told(static_cast<std::size_t>(order.agent_count()));
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    for (const ActionIndex a : order.step(number)) {
      const AgentIndex agent = order.actions()[a].agent;
      if (drive.end[a] < kNeverDone || is_told[agent]) continue;
      is_told[agent] = true;
      stuck.push_back({agent, waits_for(order, drive, number)});
    }
  }
  return stuck;
}

}  // namespace grove
