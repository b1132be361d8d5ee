// SPDX-License-Identifier: MIT
#include "primal/configurations.h"

#include <algorithm>

#include "model/assert.h"
#include "model/random.h"

namespace grove::detail {
namespace {

std::uint64_t hash_of(std::span<const AgentState> places) {
  std::uint64_t hash = 0;
  for (const AgentState& p : places)
    hash = scramble(
        hash ^ (static_cast<std::uint64_t>(p.stage) << 32 | static_cast<std::uint32_t>(p.state)));
  return hash;
}

}  // namespace

Configurations::Configurations(int agents)
    : places_(static_cast<std::size_t>(agents)), slots_(1024, kNone) {}

Configurations::Id Configurations::insert(std::span<const AgentState> places) {
  const std::uint64_t hash = hash_of(places);
  std::size_t slot = slot_of(places, hash);
  if (slots_[slot] != kNone) return slots_[slot];
  if (2 * hashes_.size() >= slots_.size()) {
    rehash();
    slot = slot_of(places, hash);
  }
  std::ranges::copy(places, places_.add().begin());
  hashes_.push_back(hash);
  GROVE_ASSERT(std::ssize(hashes_) == count() && 2 * hashes_.size() <= slots_.size(),
               "a hash set has one hash per row and is at most half full");
  return slots_[slot] = count() - 1;
}

std::size_t Configurations::growth() const {
  const bool rehashes = 2 * hashes_.size() >= slots_.size();
  return places_.growth() + (rehashes ? 2 * slots_.size() * sizeof(Id) : 0);
}

// The slot of `places`, or the free slot where it would be inserted.
std::size_t Configurations::slot_of(std::span<const AgentState> places, std::uint64_t hash) {
  std::size_t slot = hash & (slots_.size() - 1);
  while (slots_[slot] != kNone &&
         (hashes_[slots_[slot]] != hash || !std::ranges::equal((*this)[slots_[slot]], places)))
    slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

void Configurations::rehash() {
  slots_.assign(2 * slots_.size(), kNone);
  for (Id id = 0; id < count(); ++id) {
    std::size_t slot = hashes_[id] & (slots_.size() - 1);
    while (slots_[slot] != kNone) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = id;
  }
}

}  // namespace grove::detail
