// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OrderedWork.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace medialvoxel
{
namespace
{

using Work = OrderedWork<std::uint64_t>;

constexpr std::uint64_t Count = 100;

std::uint64_t
Double(const std::uint64_t number, const Work::Check &)
{
  // Later ones are ready earlier.
  std::this_thread::sleep_for(std::chrono::microseconds(100 * (7 - number % 7)));
  return 2 * number;
}

TEST(OrderedWork, TakesAllInOrder)
{
  for (const unsigned int threads : { 1u, 2u, 5u })
  {
    std::vector<std::uint64_t> taken;
    Work::Run(
      Count,
      threads,
      Double,
      [&](const std::uint64_t number, std::uint64_t && result) {
        EXPECT_EQ(number, taken.size());
        taken.push_back(result);
      },
      [] {});
    ASSERT_EQ(taken.size(), Count);
    EXPECT_EQ(taken.back(), 2 * Count - 2);
  }
  Work::Run(0, 2, Double, [](std::uint64_t, std::uint64_t &&) { ADD_FAILURE(); }, [] {});
}

TEST(OrderedWork, DoesNotRunAhead)
{
  std::atomic<std::uint64_t> taken{ 0 };
  Work::Run(
    Count,
    2,
    [&](const std::uint64_t number, const Work::Check &) {
      EXPECT_LT(number, taken + 5);
      return number;
    },
    [&](std::uint64_t, std::uint64_t &&) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      ++taken;
    },
    [] {});
}

/** Every error ends the work, and arrives. */
TEST(OrderedWork, EndsWithTheFirstError)
{
  const auto never = [](const std::uint64_t number, const Work::Check & check) {
    for (;;)
    {
      check();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return number;
  };
  const auto ignore = [](std::uint64_t, std::uint64_t &&) {};
  EXPECT_THROW(Work::Run(
                 Count,
                 2,
                 [](const std::uint64_t number, const Work::Check &) {
                   return number == 7 ? throw std::out_of_range("make") : number;
                 },
                 ignore,
                 [] {}),
               std::out_of_range);
  EXPECT_THROW(Work::Run(
                 Count, 2, Double, [](std::uint64_t, std::uint64_t &&) { throw std::length_error("take"); }, [] {}),
               std::length_error);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(Work::Run(Count, 2, never, ignore, [] { throw std::domain_error("check"); }), std::domain_error);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

} // namespace
} // namespace medialvoxel
