#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "plugins/discrepancy/simulate/observation.h"

namespace pedicel::discrepancy {

/// Motions of earlier simulations by what they were made of; those used last stay. May be used by
/// several threads at once.
class MotionCache {
 public:
  explicit MotionCache(std::size_t bytes) : capacity_(bytes) {}

  /// A motion that reaches `until` (s); nothing where there is none.
  std::shared_ptr<const Motion> find(const std::string& key, double until);
  void add(const std::string& key, std::shared_ptr<const Motion> motion);

 private:
  struct Entry {
    std::string key;
    std::shared_ptr<const Motion> motion;
    std::size_t bytes = 0;
  };
  void drop(std::list<Entry>::iterator entry);

  std::mutex mutex_;
  std::list<Entry> entries_;  // used last first
  std::map<std::string, std::list<Entry>::iterator> place_;
  std::size_t capacity_, used_ = 0;
};

}  // namespace pedicel::discrepancy
