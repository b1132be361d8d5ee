// SPDX-License-Identifier: MIT
// A rank without open nodes is helped first, whatever the bounds of what can be spared: such nodes
// may have to be expanded, and doing nothing helps nobody. A rank whose best node is worse than
// what another has plenty of is helped too, so that all work near the lower bound; with w = 0 all
// nodes below the optimum must be expanded in any case, so that is worth little, and few nodes are
// not worth a message.
#include "mpi/broker.h"

#include <algorithm>

namespace grove::detail {
namespace {

// What a rank with these open nodes can spare of its best bound; see Frontier::take_spare().
std::optional<Frontier::Level> spare(const std::vector<Frontier::Level>& levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::int64_t half = (levels[i].open + (i > 0 ? 1 : 0)) / 2;
    if (half > 0) return Frontier::Level{levels[i].bound, half};
  }
  return std::nullopt;
}

}  // namespace

Broker::Broker(int ranks, const Tuning& tuning)
    : tuning_(tuning), ranks_(static_cast<std::size_t>(ranks)) {
  for (int rank = 0; rank < ranks; ++rank) place(rank);
}

void Broker::heard(int rank, const message::Status& status) {
  view(rank).levels = status.levels;
  view(rank).idle = status.idle;
  place(rank);
}

void Broker::arrived(int rank) {
  view(rank).awaits = false;
  place(rank);
}

// Among the offers and the wants as it is now.
void Broker::place(int rank) {
  View& at = view(rank);
  if (at.offer) offers_.erase(*at.offer);
  if (at.want) wants_.erase(*at.want);
  at.offer.reset();
  at.want.reset();
  if (const auto level = spare(at.levels))
    offers_.insert(at.offer.emplace(level->bound, -level->open, rank));
  const Cost best = at.levels.empty() ? kInfiniteCost : at.levels.front().bound;
  if (!at.awaits) wants_.insert(at.want.emplace(!at.idle, -best, rank));
}

std::optional<Broker::Gift> Broker::next() {
  if (offers_.empty() || wants_.empty()) return std::nullopt;
  const auto [bound, minus_nodes, from] = *offers_.begin();
  const auto [busy, minus_best, to] = *wants_.begin();
  const Cost best = -minus_best;
  const bool helps =
      best == kInfiniteCost || (best > bound && -minus_nodes >= tuning_.plenty_nodes);
  if (from == to || !helps) return std::nullopt;
  const Gift gift{from, to, std::min(-minus_nodes, tuning_.gift_nodes)};
  for (Frontier::Level& level : view(from).levels)
    if (level.bound == bound) level.open -= gift.nodes;
  view(to).awaits = true;
  place(from);
  place(to);
  return gift;
}

}  // namespace grove::detail
