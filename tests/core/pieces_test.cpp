#include "core/pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vlbeam {
namespace {

/// Calls f with one thread, two and more than there are pieces at once.
template <class Function>
void with_threads(const Function& f) {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    f();
  }
}

constexpr std::ptrdiff_t counts[] = {0, 1, 100, long_range / 4 - 1, long_range / 4, long_range + 1, 3 * long_range + 7};

TEST(Pieces, MakeUpTheRange) {
  with_threads([] {
    for (const std::ptrdiff_t count : counts) {
      for (const std::ptrdiff_t size : {1, 4, 3 * static_cast<int>(piece_of_range)}) {
        std::vector<int> visits(static_cast<std::size_t>(count));
        const auto visit = [&](std::ptrdiff_t first, std::ptrdiff_t number) {
          for (std::ptrdiff_t i = first; i < first + number; ++i) ++visits[static_cast<std::size_t>(i)];
        };
        in_pieces(count, size, visit);
        in_meeting_pieces(count, size, visit);
        EXPECT_EQ(visits, std::vector<int>(static_cast<std::size_t>(count), 2)) << count << " of " << size;
      }
    }
  });
}

TEST(Pieces, MayAddToWhereTheyMeet) {
  with_threads([] {
    for (const std::ptrdiff_t count : counts) {
      std::vector<int> sums(static_cast<std::size_t>(count) + 1);
      for (int repeat = 0; repeat < 20; ++repeat) {
        in_meeting_pieces(count, 4, [&](std::ptrdiff_t first, std::ptrdiff_t number) {
          for (std::ptrdiff_t i = first; i < first + number; ++i) {
            ++sums[static_cast<std::size_t>(i)];
            ++sums[static_cast<std::size_t>(i) + 1];
          }
        });
      }
      for (std::ptrdiff_t i = 0; i <= count; ++i) {
        ASSERT_EQ(sums[static_cast<std::size_t>(i)], count == 0 ? 0 : i == 0 || i == count ? 20 : 40) << i;
      }
    }
  });
}

TEST(Pieces, SumsDoNotDependOnThreads) {
  const auto part = [](std::ptrdiff_t first, std::ptrdiff_t number) {
    double sum = 0;
    for (std::ptrdiff_t i = first; i < first + number; ++i) sum += std::sqrt(static_cast<double>(i));
    return sum;
  };
  for (const std::ptrdiff_t count : counts) {
    std::vector<double> sums, meeting;
    with_threads([&] {
      sums.push_back(sum_in_pieces<double>(count, 1, part));
      meeting.push_back(sum_in_meeting_pieces<double>(count, 1, part));
    });
    EXPECT_EQ(sums, std::vector<double>(3, sums.front()));
    EXPECT_EQ(meeting, sums);
    EXPECT_NEAR(sums.front(), part(0, count), 1e-12 * part(0, count));
  }
}

}  // namespace
}  // namespace vlbeam
