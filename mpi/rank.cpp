// SPDX-License-Identifier: MIT
#include "mpi/rank.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kLevels = 4;
constexpr std::size_t kNodesInAPart = 500;
// Between two statuses that nothing hangs on, in seconds. The coordinator hears all ranks.
constexpr double kPause = 2e-3;
constexpr double kPausePerRank = 50e-6;

// What a rank with so many open nodes can spare, about; see Frontier::take_spare().
std::int64_t spare(const message::Status& status) {
  return status.open / 2;
}

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;  // clang 16 asks for it

}  // namespace

Rank::Rank(const Problem& problem, const SolveOptions& options, const Limits& limits,
           Transport& transport, const AgentStopsStore& stops)
    : problem_(problem),
      omega_(options.omega),
      limits_(limits),
      transport_(transport),
      stops_(stops),
      ledger_(limits, nodes_.frontier),
      search_(options, limits, nodes_, ledger_, elsewhere_, unwatched_),
      trees_(problem, stops_, nodes_.pool) {
  if (transport.rank() == 0) search_.lagrangian().set_ranks(transport.ranks());
}

void Rank::handle(int from, message::Message&& message) {
  const auto unexpected = [](const auto&) {
    throw std::invalid_argument("a message for the coordinator came to a rank");
  };
  std::visit(Overloaded{[&](message::Batch& batch) { take_over(from, batch); },
                        [&](message::AskPrices& ask) {
                          search_.lagrangian().help(problem_.instance, std::move(ask.share));
                        },
                        [&](message::Prices& prices) {
                          ledger_.prove(search_.lagrangian().accept(from, std::move(prices.answer)),
                                        ProvenBy::kLagrangian);
                        },
                        [&](message::NewTree& tree) {
                          roots_[tree.number] = trees_.add(tree.tree, tree.number);
                          take_over_held();
                        },
                        [&](message::Entrust& entrusted) { accept(entrusted); },
                        [&](message::Order& order) { give(order); },
                        [&](message::Release& covered) { release(covered); },
                        [&](message::Incumbent& incumbent) {
                          const Cost cost = incumbent.plan.cost;
                          ledger_.adopt(std::move(incumbent.plan));
                          nodes_.prune(cost);
                        },
                        [&](message::BeginAnew& anew) { begin_anew(anew.proven); },
                        [&](message::Gather&) { gather(); }, [&](message::More&) { send_part(); },
                        [&](message::End&) {
                          ended_ = true;
                          ledger_.end();
                        },
                        [&](message::Goodbye& goodbye) { batches_to_come_ = goodbye.batches; },
                        unexpected},
             message);
}

// Its tree may not have been heard of yet, or what was given up here has yet to be forgotten.
bool Rank::is_early(const message::Batch& batch) const {
  return batch.era > era_ || std::ranges::any_of(batch.nodes, [&](const NodeRecord& node) {
           return !roots_.contains(node.tree);
         });
}

void Rank::take_over(int from, message::Batch& batch) {
  const bool must_wait = std::ranges::any_of(held_, [&](const Held& h) { return h.from == from; });
  if (must_wait || is_early(batch)) {
    held_.push_back({from, std::move(batch)});
    return;
  }
  push(batch.nodes, batch.findings);
  Peer& peer = peers_[from];
  ++peer.taken;
  ++batches_taken_;
  peer.news = true;
  urgent_ = true;
}

void Rank::take_over_held() {
  for (auto& [from, batch] : std::exchange(held_, {})) take_over(from, batch);
}

// What is given stays in custody: taken from the frontier, but not settled.
void Rank::give(const message::Order& order) {
  const auto nodes = nodes_.frontier.take_spare(static_cast<std::size_t>(order.count));
  message::Batch batch;
  batch.era = era_;
  for (const NodePtr& node : nodes) batch.nodes.push_back(record_of(*node));
  batch.findings = findings_about(nodes, *search_.memory());
  Peer& peer = peers_[order.to];
  peer.custody[peer.sent + 1] = nodes;
  in_custody_ += std::ssize(nodes);
  send(order.to, batch);
  ++peer.sent;
  nodes_sent_ += std::ssize(nodes);
  urgent_ = true;
}

void Rank::release(const message::Release& covered) {
  Peer& peer = peers_[covered.to];
  while (!peer.custody.empty() && peer.custody.begin()->first <= covered.batches) {
    for (const NodePtr& node : peer.custody.begin()->second) nodes_.frontier.settle(node);
    in_custody_ -= std::ssize(peer.custody.begin()->second);
    peer.custody.erase(peer.custody.begin());
  }
}

void Rank::accept(const message::Entrust& entrusted) {
  push(entrusted.nodes, {});
  nodes_.frontier.note_evicted(entrusted.evicted_bound);
  ++entrusted_;
  urgent_ = true;
}

void Rank::push(const std::vector<NodeRecord>& records, const std::vector<Finding>& findings) {
  std::vector<NodePtr> nodes;  // null: pruned
  for (const NodeRecord& record : records) {
    const NodePtr& root = roots_.at(record.tree);
    const bool pruned = record.bound >= ledger_.cutoff();
    nodes.push_back(pruned ? nullptr : node_of(record, root, problem_.instance));
  }
  learn(findings, nodes, *search_.memory());
  for (NodePtr& node : nodes)
    if (node) nodes_.push(std::move(node));
}

// A plan was posted before the node that led to it was gone.
void Rank::gather() {
  Frontier::Snapshot snapshot = nodes_.frontier.snapshot();
  send_found();
  gathered_ = std::move(snapshot.live);
  send(0, message::Gathered{snapshot.evicted_bound});
}

void Rank::send_part() {
  message::Part part;
  while (!gathered_.empty() && part.nodes.size() < kNodesInAPart) {
    part.nodes.push_back(record_of(*gathered_.back()));
    gathered_.pop_back();
  }
  part.last = gathered_.empty();
  send(0, part);
}

void Rank::begin_anew(Cost proven) {
  nodes_.restart({}, proven);
  ++era_;
  urgent_ = true;
  take_over_held();
}

// Workers go on meanwhile. Where no node is live none is given up any more, so what was is asked
// for later: a new beginning must know all of it.
message::Status Rank::status() const {
  message::Status status;
  status.live = static_cast<std::int64_t>(nodes_.frontier.live());
  status.evicted_bound = nodes_.evicted_bound();
  std::tie(status.proven, status.proven_by) = ledger_.proven();
  status.bound = nodes_.bound();
  status.levels = nodes_.frontier.levels(kLevels);
  const bool has_open = !status.levels.empty();
  std::erase_if(status.levels,
                [&](const Frontier::Level& level) { return !is_wanted(level.bound); });
  status.idle = status.live == in_custody_ || (has_open && status.levels.empty());
  status.open = static_cast<std::int64_t>(nodes_.frontier.open());
  status.expanded = nodes_.expanded;
  status.era = era_;
  status.entrusted = entrusted_;
  limits_.stop_requested();  // nobody else may look
  status.stopped = limits_.reason();
  for (const auto& [rank, peer] : peers_)
    if (peer.news) status.batches.emplace_back(rank, peer.taken);
  return status;
}

// Does the end wait for nodes of this bound? Not where the incumbent is within w of it: who has
// no others expands them for want of better, but had rather be given some, and has nothing to give.
// (128 ranks that proved 1 % took 1.7 times as long when they passed such nodes around.)
bool Rank::is_wanted(Cost bound) const {
  const Cost cutoff = ledger_.cutoff();
  return cutoff == kInfiniteCost || !omega_.accepts(cutoff, bound);
}

// A node that led to a plan is settled after the plan was posted. So a status that does not count
// the node any more is made before plans are looked for, and sent after them.
//
// What can be spared matters at once when it has doubled: while few ranks have nodes the others
// would wait a pause for each doubling.
void Rank::speak(double now) {
  if (ended_) return;
  speak_of_prices();
  message::Status status = this->status();
  send_found();
  const bool at_once = urgent_ || status.bound != said_.bound || status.proven != said_.proven ||
                       status.stopped != said_.stopped || status.idle != said_.idle ||
                       (status.live == 0) != (said_.live == 0);
  const bool has_more = !status.levels.empty() && spare(status) > 2 * spare(said_);
  const bool changed = status.expanded != said_.expanded || status.open != said_.open;
  if (!at_once && !has_more && !(changed && now >= said_at_ + pause(transport_.ranks()))) return;
  send(0, status);
  for (auto& [rank, peer] : peers_) peer.news = false;
  said_ = std::move(status);
  said_at_ = now;
  urgent_ = false;
}

void Rank::speak_of_prices() {
  for (auto& [rank, share] : search_.lagrangian().share_out())
    send(rank, message::AskPrices{std::move(share)});
  if (auto answer = search_.lagrangian().take_answer())
    send(0, message::Prices{std::move(*answer)});
}

double Rank::pause(int ranks) {
  return kPause + kPausePerRank * ranks;
}

void Rank::send_found() {
  if (auto found = ledger_.take_found())
    send(0, message::Found{std::move(found->plan), found->source});
}

Account Rank::account(Stats counts) const {
  search_.add_counts(counts);
  counts.counts["messages"] += transport_.messages();
  counts.counts["message_bytes"] += transport_.bytes();
  counts.counts["nodes_sent"] += nodes_sent_;
  std::int64_t& batches = counts.counts["batches"];
  for (const auto& [rank, peer] : peers_) batches += peer.sent;
  return {std::move(counts.counts), search_.memory_use()};
}

void Rank::account_for(Stats counts) {
  if (!ended_) send(0, message::Account{account(std::move(counts))});
}

// Limits may strike just when a plan was found.
void Rank::farewell(Stats counts) {
  send_found();
  message::Farewell farewell;
  farewell.account = account(std::move(counts));
  for (const auto& [rank, peer] : peers_) farewell.batches.emplace_back(rank, peer.sent);
  send(0, farewell);
}

bool Rank::left() const {
  const auto held = static_cast<std::int64_t>(held_.size());
  return batches_to_come_ && batches_taken_ + held >= *batches_to_come_;
}

void Rank::send(int to, const message::Message& message) {
  transport_.send(to, message::bytes_of(message));
}

}  // namespace grove::detail
