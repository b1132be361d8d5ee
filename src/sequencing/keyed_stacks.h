// SPDX-License-Identifier: MIT
// Priority queue for many small entries with few distinct keys: one stack per key.
#pragma once

#include <map>
#include <vector>

#include "model/assert.h"

namespace grove::detail {

// pop() removes an entry of the least key; among several, the one pushed last. One thread at a
// time.
template <class Key, class Entry>
class KeyedStacks {
 public:
  bool empty() const { return stacks_.empty(); }
  const Key& top_key() const { return stacks_.begin()->first; }

  void push(const Key& key, const Entry& entry) { stacks_[key].push_back(entry); }

  Entry pop() {
    GROVE_ASSERT(!empty() && !stacks_.begin()->second.empty(), "each key has an entry");
    const auto top = stacks_.begin();
    const Entry entry = top->second.back();
    top->second.pop_back();
    if (top->second.empty()) stacks_.erase(top);
    return entry;
  }

 private:
  std::map<Key, std::vector<Entry>> stacks_;  // no stack is empty
};

}  // namespace grove::detail
