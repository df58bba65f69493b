#include "engine/core/huge_pages.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace pedicel {

namespace {
constexpr std::size_t page = std::size_t{1} << 21;
}  // namespace

HugePages::~HugePages() {
  for (void* block : blocks_) std::free(block);
}

void* HugePages::do_allocate(std::size_t bytes, std::size_t alignment) {
  if (!std::align(alignment, bytes, free_, left_)) {
    if (alignment > page) throw std::bad_alloc();
    add_pages(bytes);
  }
  void* const memory = free_;
  free_ = static_cast<char*>(free_) + bytes;
  left_ -= bytes;
  return memory;
}

void HugePages::add_pages(std::size_t bytes) {
  const std::size_t size = std::max<std::size_t>((bytes + page - 1) / page, 1) * page;
  blocks_.reserve(blocks_.size() + 1);
  void* const block = size >= bytes ? std::aligned_alloc(page, size) : nullptr;
  if (!block) throw std::bad_alloc();
#ifdef __linux__
  madvise(block, size, MADV_HUGEPAGE);  // if the system has none, they are small
#endif
  blocks_.push_back(block);
  free_ = block;
  left_ = size;
}

}  // namespace pedicel
