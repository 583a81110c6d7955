#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <map>
#include <utility>

namespace farol {

/// Values by key within a bound of cost (bytes, or a count), least recently used first out. The
/// latest value stays even where it alone is over the bound. Not for several threads at once.
template <typename Key, typename Value>
class LruCache {
  public:
    explicit LruCache(std::size_t most) : most_(most) {}

    /// The value, now the most recent, or null. Valid until it is dropped by put().
    Value* find(const Key& key) {
        const auto found = byKey_.find(key);
        if (found == byKey_.end()) return nullptr;
        entries_.splice(entries_.begin(), entries_, found->second);
        return &entries_.front().value;
    }

    /// Precondition: the key is not here. Drops the least recent until the bound is kept, but none
    /// of the `keep` most recent.
    Value& put(const Key& key, Value value, std::size_t cost, std::size_t keep = 1) {
        entries_.push_front({key, std::move(value), cost});
        byKey_.emplace(key, entries_.begin());
        cost_ += cost;
        while (cost_ > most_ && entries_.size() > std::max<std::size_t>(1, keep)) {
            cost_ -= entries_.back().cost;
            byKey_.erase(entries_.back().key);
            entries_.pop_back();
        }
        return entries_.front().value;
    }

    std::size_t size() const { return entries_.size(); }

  private:
    struct Entry {
        Key key;
        Value value;
        std::size_t cost;
    };
    std::size_t most_, cost_ = 0;
    std::list<Entry> entries_;  ///< most recent first
    std::map<Key, typename std::list<Entry>::iterator> byKey_;
};

}  // namespace farol
