#include "engine/core/huge_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <new>

namespace pedicel {
namespace {

constexpr std::size_t page = std::size_t{1} << 21;

std::uintptr_t address(const void* memory) {
  return reinterpret_cast<std::uintptr_t>(memory);
}

TEST(HugePages, SmallPiecesShareAPageAndDoNotOverlap) {
  HugePages pages;
  void* const first = pages.allocate(100, 64);
  void* const second = pages.allocate(1, 1);
  void* const third = pages.allocate(6400, 64);
  EXPECT_EQ(address(first) % page, 0u);
  EXPECT_EQ(address(second), address(first) + 100);
  EXPECT_EQ(address(third), address(first) + 128);
}

TEST(HugePages, WhatDoesNotFitTakesPagesOfItsOwn) {
  HugePages pages;
  void* const first = pages.allocate(page - 64, 64);
  void* const second = pages.allocate(5 * page / 2, 64);
  void* const third = pages.allocate(page / 2, 64);  // fills the second one's last page
  EXPECT_EQ(address(second) % page, 0u);
  EXPECT_EQ(address(third), address(second) + 5 * page / 2);
  std::memset(first, 1, page - 64);
  std::memset(second, 2, 5 * page / 2);
  std::memset(third, 3, page / 2);
  EXPECT_EQ(static_cast<char*>(first)[page - 65], 1);
  EXPECT_EQ(static_cast<char*>(second)[5 * page / 2 - 1], 2);
}

TEST(HugePages, SaysWhatItCannotGive) {
  HugePages pages;
  const std::size_t most = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(static_cast<void>(pages.allocate(most, 64)), std::bad_alloc);
  EXPECT_THROW(static_cast<void>(pages.allocate(64, 2 * page)), std::bad_alloc);
  EXPECT_NE(pages.allocate(64, 64), nullptr);
}

}  // namespace
}  // namespace pedicel
