// SPDX-License-Identifier: MIT
// A priority queue for many small entries on few distinct keys.
#pragma once

#include <map>
#include <vector>

namespace grove {

// Pops an entry of the least key; among equals the last one pushed.
template <class Key, class Entry>
class BucketQueue {
 public:
  bool empty() const { return buckets_.empty(); }
  const Key& top_key() const { return buckets_.begin()->first; }

  void push(const Key& key, const Entry& entry) { buckets_[key].push_back(entry); }

  Entry pop() {
    const auto top = buckets_.begin();
    const Entry entry = top->second.back();
    top->second.pop_back();
    if (top->second.empty()) buckets_.erase(top);
    return entry;
  }

 private:
  std::map<Key, std::vector<Entry>> buckets_;  // none is empty
};

}  // namespace grove
