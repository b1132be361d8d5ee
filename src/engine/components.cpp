// SPDX-License-Identifier: MIT
#include "engine/components.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "model/limits.h"

namespace grove::detail {
namespace {

using Make = std::unique_ptr<Component> (*)(const ComponentContext&);

// By ComponentId.
constexpr std::array kMakers = {
#define GROVE_COMPONENT(id, name, make) Make(make),
#include "engine/components.def"
#undef GROVE_COMPONENT
};

}  // namespace

void Component::receive(int /*from*/, const ComponentMessage& /*message*/) {
  throw std::invalid_argument("component: message for a component that receives none");
}

Components::Components(const Problem& problem, const SolveOptions& options, const Limits& limits,
                       const AgentStopsCache& stops, LocalNodes& nodes, SharedBounds& bounds,
                       TreeSupply& trees, WorkObserver& observer, ProcessPlace place)
    : stops_(stops), memory_(options, limits, nodes, observer), context_{problem,    options,
                                                                         limits,     stops_,
                                                                         bounds,     nodes,
                                                                         memory_,    trees,
                                                                         observer,   results_,
                                                                         place.rank, place.ranks} {
  for (const Make make : kMakers) components_.push_back(make(context_));
  const std::size_t tree = static_cast<std::size_t>(ComponentId::kTree);
  tree_ = static_cast<TreeSearch*>(components_[tree].get());
}

std::vector<Scheduler::Entry> Components::sources(int worker) {
  std::vector<Scheduler::Entry> entries;
  for (const auto& component : components_)
    if (component)
      if (auto source = component->source(worker))
        entries.push_back({component->tier(), std::move(source)});
  return entries;
}

bool Components::has_work() const {
  return std::ranges::any_of(components_, [](const auto& c) { return c && c->has_work(); });
}

void Components::keep_within_memory() {
  for (const auto& component : components_)
    if (component) component->keep_within_memory();
}

void Components::add_counts(Counters& counters) const {
  for (const auto& component : components_)
    if (component) component->add_counts(counters);
}

MemoryUse Components::memory_use() const {
  MemoryUse memory;
  memory.process = static_cast<std::int64_t>(resident_bytes());
  for (const auto& component : components_)
    if (component) component->add_memory(memory);
  return memory;
}

void Components::log_proof(ProofLog& proof) const {
  for (const auto& component : components_)
    if (component) component->log_proof(proof);
}

std::vector<std::pair<int, ComponentMessage>> Components::take_messages() {
  std::vector<std::pair<int, ComponentMessage>> messages;
  for (const auto& component : components_)
    if (component)
      for (auto& message : component->take_messages()) messages.push_back(std::move(message));
  return messages;
}

void Components::receive(int from, const ComponentMessage& message) {
  Component* const component = components_.at(static_cast<std::size_t>(message.component)).get();
  if (component == nullptr)
    throw std::invalid_argument("component: message for a component that is not enabled");
  component->receive(from, message);
}

}  // namespace grove::detail
