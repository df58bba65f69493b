// What is asked for shows in nothing but time (the benchmarks of rows); how it is shared out does.
#include "plugins/cosserat/lanes/fetch_ahead.h"

#include <gtest/gtest.h>

namespace pedicel::cosserat {
namespace {

TEST(FetchAhead, AsksForAllOfItInSoManyCallsAndNoneFewer) {
  const std::vector<double> first(8 * 10), nothing;  // ten lines of 64 bytes
  const std::vector<char> second(1);
  FetchAhead ahead;
  ahead.add(first);
  ahead.add(nothing);
  ahead.add(second);
  for (const int calls : {1, 2, 6, 11}) {  // of 11, 6, 2 and 1 lines
    FetchAhead one = ahead;
    one.share_out(calls);
    for (int i = 0; i < calls; ++i) {
      EXPECT_FALSE(one.is_done()) << i << " of " << calls;
      one.some();
    }
    EXPECT_TRUE(one.is_done()) << calls;
    one.some();
    EXPECT_TRUE(one.is_done());
  }
}

TEST(FetchAhead, BeginsAgainWhenCleared) {
  const std::vector<double> values(64);
  FetchAhead ahead;
  EXPECT_TRUE(ahead.is_done());
  ahead.add(values);
  ahead.share_out(1);
  ahead.some();
  EXPECT_TRUE(ahead.is_done());
  ahead.clear();
  ahead.add(values);
  EXPECT_FALSE(ahead.is_done());
  ahead.share_out(0);  // nobody to ask
  EXPECT_FALSE(ahead.is_done());
}

}  // namespace
}  // namespace pedicel::cosserat
