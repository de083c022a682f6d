// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSurfaceComponents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

TEST(MedialVoxelSurfaceComponents, AreThoseOfALabelThatSpreads)
{
  std::mt19937 generator(5);
  for (int trial = 0; trial < 20; ++trial)
  {
    const std::uint64_t                       vertices = 60;
    std::vector<std::array<std::uint64_t, 4>> quads(5 + trial);
    itk::MedialVoxelSurfaceComponents         components;
    components.AddVertices(vertices / 2);
    components.AddVertices(vertices - vertices / 2);
    std::vector<std::uint64_t> labels(vertices);
    for (std::uint64_t i = 0; i < vertices; ++i)
    {
      labels[i] = i;
    }
    for (auto & quad : quads)
    {
      for (auto & vertex : quad)
      {
        vertex = generator() % vertices;
      }
      components.AddQuad(quad);
    }
    for (bool changed = true; changed;)
    {
      changed = false;
      for (const auto & quad : quads)
      {
        const auto least = std::min({ labels[quad[0]], labels[quad[1]], labels[quad[2]], labels[quad[3]] });
        for (const auto vertex : quad)
        {
          changed = changed || labels[vertex] != least;
          labels[vertex] = least;
        }
      }
    }
    std::map<std::uint64_t, std::uint64_t> sizes;
    for (const auto & quad : quads)
    {
      ++sizes[labels[quad[0]]];
    }
    components.Keep(3);
    std::uint64_t number = 0;
    for (std::uint64_t i = 0; i < vertices; ++i)
    {
      ASSERT_EQ(components.IsKept(i), sizes[labels[i]] >= 3) << i;
      if (components.IsKept(i))
      {
        EXPECT_EQ(components.NumberOf(i), number++);
      }
    }
  }
}

TEST(MedialVoxelSurfaceComponents, TooManyVerticesAreRefused)
{
  itk::MedialVoxelSurfaceComponents components;
  EXPECT_THROW(components.AddVertices(std::uint64_t{ 1 } << 31), std::length_error);
}
