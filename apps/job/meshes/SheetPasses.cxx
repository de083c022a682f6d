// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetPasses.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{

/** \class SheetPasses::Pass
 * \brief The surface of a pass, whose vertices get other numbers. */
class SheetPasses::Pass : public itk::MedialVoxelSurfaceConsumer
{
public:
  explicit Pass(SheetPasses & owner)
    : observer(owner.m_MakeObserver(*this))
    , m_Owner(owner)
  {}

  void
  AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices) override
  {
    const std::uint64_t number = m_Owner.m_NumberOfVertices;
    if (m_Runs.empty() || m_Runs.back().number + (m_NumberOfVertices - m_Runs.back().first) != number)
    {
      m_Runs.push_back({ m_NumberOfVertices, number });
    }
    m_NumberOfVertices += vertices.size();
    m_Owner.m_NumberOfVertices += vertices.size();
    m_Owner.m_Consumer.AddVertices(vertices);
  }

  void
  AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads) override
  {
    std::vector<itk::MedialVoxelSurfaceQuad> renumbered = quads;
    for (itk::MedialVoxelSurfaceQuad & quad : renumbered)
    {
      std::transform(quad.vertices.begin(), quad.vertices.end(), quad.vertices.begin(), [this](std::uint64_t vertex) {
        return this->GetNumber(vertex);
      });
    }
    m_Owner.m_Consumer.AddQuads(renumbered);
  }

  const std::unique_ptr<itk::MedialVoxelSurfaceObserver> observer;

private:
  /** Vertices whose numbers follow each other. */
  struct Run
  {
    std::uint64_t first;  ///< number in the pass
    std::uint64_t number; ///< of all passes
  };

  std::uint64_t
  GetNumber(std::uint64_t vertex) const
  {
    const auto next = std::upper_bound(
      m_Runs.begin(), m_Runs.end(), vertex, [](std::uint64_t value, const Run & run) { return value < run.first; });
    const Run & run = *std::prev(next);
    return run.number + (vertex - run.first);
  }

  SheetPasses &    m_Owner;
  std::vector<Run> m_Runs;
  std::uint64_t    m_NumberOfVertices{ 0 };
};

SheetPasses::SheetPasses(MakeObserver makeObserver, itk::MedialVoxelSurfaceConsumer & consumer)
  : m_MakeObserver(std::move(makeObserver))
  , m_Consumer(consumer)
{
  this->BeginPass(0);
}

SheetPasses::~SheetPasses() = default;

void
SheetPasses::BeginPass(unsigned int pass)
{
  while (m_Passes.size() <= pass)
  {
    m_Passes.push_back(std::make_unique<Pass>(*this));
  }
  m_Current = pass;
}

void
SheetPasses::Finish()
{
  for (const auto & pass : m_Passes)
  {
    pass->observer->Finish();
  }
}

std::uint64_t
SheetPasses::GetBytesPerVoxel() const
{
  return m_Passes.front()->observer->GetBytesPerVoxel();
}

auto
SheetPasses::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return m_Passes.front()->observer->MakeWorkspace();
}

void
SheetPasses::Begin()
{
  m_Passes[m_Current]->observer->Begin();
}

itk::MedialVoxelBox
SheetPasses::Examine(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) const
{
  return m_Passes[m_Current]->observer->Examine(tile, workspace);
}

void
SheetPasses::Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace)
{
  m_Passes[m_Current]->observer->Observe(tile, workspace);
}

void
SheetPasses::Commit()
{
  m_Passes[m_Current]->observer->Commit();
}

} // end namespace medialvoxel
