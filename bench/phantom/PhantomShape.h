// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef PhantomShape_h
#define PhantomShape_h

#include "PhantomGeometry.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace phantom
{
using Size = std::array<std::int64_t, 3>;

/** A part, as an implicit function of the position of a voxel center (index units). */
class Shape
{
public:
  virtual ~Shape() = default;

  /** Negative inside. About the distance to the surface, never changing by more than GetLipschitzConstant() a voxel. */
  virtual double
  Evaluate(const Vector & position) const = 0;

  virtual double
  GetLipschitzConstant() const
  {
    return 1.0;
  }
};

struct ShapeParameters
{
  Size   size{ 0, 0, 0 };         // voxels; zero takes the default of the kind
  double wall{ 4.0 };             // voxels; plate, shell and t-junction only
  Vector normal{ 0.0, 0.0, 1.0 }; // any length; plate only
};

/** One name a kind, in the order of the help text. */
const std::vector<std::string> &
GetKinds();

/** Size of a kind when none is asked for.
 *  \exception std::invalid_argument on an unknown kind. */
Size
GetDefaultSize(const std::string & kind);

/** \exception std::invalid_argument on an unknown kind, a wall <= 0 or a zero normal. */
std::unique_ptr<Shape>
MakeShape(const std::string & kind, const ShapeParameters & parameters);

std::unique_ptr<Shape>
MakeSideFrame(const Size & size);

std::unique_ptr<Shape>
MakeCover(const Size & size);

std::unique_ptr<Shape>
MakeSolids(const Size & size);
} // namespace phantom

#endif
