// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "KernelScene.h"

#include "itkMedialVoxelBoundary.h"

#include "PhantomRasterizer.h"

#include <utility>

namespace
{
constexpr std::int64_t edge = 192;

/** A part seen from another origin. */
class MovedShape : public phantom::Shape
{
public:
  MovedShape(std::unique_ptr<phantom::Shape> shape, const phantom::Vector & origin)
    : m_Shape(std::move(shape))
    , m_Origin(origin)
  {}

  double
  Evaluate(const phantom::Vector & position) const override
  {
    return m_Shape->Evaluate({ position.x + m_Origin.x, position.y + m_Origin.y, position.z + m_Origin.z });
  }

  double
  GetLipschitzConstant() const override
  {
    return m_Shape->GetLipschitzConstant();
  }

private:
  std::unique_ptr<phantom::Shape> m_Shape;
  phantom::Vector                 m_Origin;
};

KernelScene
MakeScene(const phantom::Shape & shape)
{
  std::vector<unsigned char> mask;
  phantom::RasterizeSlab(shape, {}, { edge, edge, edge }, 0, edge, 1, mask);

  KernelScene scene;
  scene.grid = itk::MedialVoxelGrid({ { edge, edge, edge } }, { { 1.0, 1.0, 1.0 } });
  scene.object.Reshape(scene.grid.GetVoxelBox());
  scene.boundary.Reshape(scene.grid.GetVoxelBox());
  for (std::int64_t i = 0; i < edge * edge * edge; ++i)
  {
    if (mask[static_cast<std::size_t>(i)] != 0)
    {
      scene.object.Set({ { i % edge, i / edge % edge, i / (edge * edge) } });
    }
  }
  itk::MedialVoxelComputeBoundary(scene.object,
                                  scene.grid.GetVoxelBox(),
                                  itk::MedialVoxelBoundary::Background,
                                  scene.grid.GetVoxelBox(),
                                  scene.boundary);
  return scene;
}
} // namespace

const KernelScene &
GetKernelScene(KernelSceneName name)
{
  if (name == ThinScene)
  {
    static const KernelScene thin =
      MakeScene(MovedShape(phantom::MakeSideFrame(phantom::GetDefaultSize("side-frame")), { 40.0, 300.0, 60.0 }));
    return thin;
  }
  static const KernelScene thick = MakeScene(*phantom::MakeSolids({ edge, edge, edge }));
  return thick;
}

const char *
GetKernelSceneLabel(KernelSceneName name)
{
  return name == ThinScene ? "thin" : "thick";
}
