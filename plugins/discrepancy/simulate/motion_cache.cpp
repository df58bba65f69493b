#include "plugins/discrepancy/simulate/motion_cache.h"

namespace pedicel::discrepancy {

std::shared_ptr<const Motion> MotionCache::find(const std::string& key, double until) {
  const std::lock_guard lock(mutex_);
  const auto place = place_.find(key);
  if (place == place_.end()) return nullptr;
  const auto entry = place->second;
  if (entry->motion->time.back() < until - 1.0e-9) return nullptr;
  entries_.splice(entries_.begin(), entries_, entry);
  return entry->motion;
}

void MotionCache::add(const std::string& key, std::shared_ptr<const Motion> motion) {
  const auto size = motion->position.size() + motion->velocity.size() + motion->turn.size() +
                    motion->force.size() + motion->wrench.size();
  const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(size);
  const std::lock_guard lock(mutex_);
  if (const auto place = place_.find(key); place != place_.end()) drop(place->second);
  if (bytes > capacity_) return;
  while (used_ + bytes > capacity_) drop(std::prev(entries_.end()));
  entries_.push_front({key, std::move(motion), bytes});
  place_[key] = entries_.begin();
  used_ += bytes;
}

void MotionCache::drop(std::list<Entry>::iterator entry) {
  used_ -= entry->bytes;
  place_.erase(entry->key);
  entries_.erase(entry);
}

}  // namespace pedicel::discrepancy
