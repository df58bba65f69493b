#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

namespace pedicel {

/// Memory in pages of 2 MB, where the system has them to give (Linux: transparent huge pages). A
/// core knows by heart where some thousand pages are and looks every other one up, which takes as
/// long as fetching from it: worth it for what is larger than those are in pages of 4 kB.
/// What is given back is kept until the end. One thread at a time may ask. Throws std::bad_alloc.
class HugePages : public std::pmr::memory_resource {
 public:
  HugePages() = default;
  ~HugePages() override;
  HugePages(const HugePages&) = delete;
  HugePages& operator=(const HugePages&) = delete;

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
    return this == &other;
  }
  void add_pages(std::size_t bytes);

  std::vector<void*> blocks_;  // of whole pages
  void* free_ = nullptr;       // the rest of the last one
  std::size_t left_ = 0;       // bytes
};

}  // namespace pedicel
