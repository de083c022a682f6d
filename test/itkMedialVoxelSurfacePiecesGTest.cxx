// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelSurfacePieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

TEST(MedialVoxelSurfacePieces, AreThoseOfALabelThatSpreads)
{
  std::mt19937 generator(5);
  for (int trial = 0; trial < 20; ++trial)
  {
    const std::uint64_t                       vertices = 60;
    std::vector<std::array<std::uint64_t, 4>> quads(5 + trial);
    itk::MedialVoxelSurfacePieces             pieces;
    pieces.AddVertices(vertices / 2);
    pieces.AddVertices(vertices - vertices / 2);
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
      pieces.AddQuad(quad);
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
    pieces.Keep(3);
    std::uint64_t number = 0;
    for (std::uint64_t i = 0; i < vertices; ++i)
    {
      ASSERT_EQ(pieces.IsKept(i), sizes[labels[i]] >= 3) << i;
      if (pieces.IsKept(i))
      {
        EXPECT_EQ(pieces.NumberOf(i), number++);
      }
    }
  }
}

TEST(MedialVoxelSurfacePieces, TooManyVerticesAreRefused)
{
  itk::MedialVoxelSurfacePieces pieces;
  EXPECT_THROW(pieces.AddVertices(std::uint64_t{ 1 } << 31), std::length_error);
}
