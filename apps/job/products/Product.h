// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProduct_h
#define medialvoxelProduct_h

#include "Footprint.h"
#include "InputVolume.h"
#include "JobResult.h"
#include "OutputSet.h"
#include "Survey.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

class SurfaceMesh;
struct Pictures;

/** What products begin with. */
struct ProductStart
{
  const JobResult & job;              ///< header and plan
  InputVolume *     input{ nullptr }; ///< null: parts that others found are put together

  // Of the products before.
  const Survey *   survey{ nullptr };
  const Pictures * pictures{ nullptr }; ///< they are drawn at the end
};

/** What products are completed with. */
struct ProductEnd
{
  const OutputSet &           outputs;  ///< whose volumes are finished
  InputVolume *               input;    ///< as at the start
  std::function<void(double)> progress; ///< may throw to stop
};

/** A volume that an engine fills. */
struct FilledVolume
{
  const VolumeRequest & request;
  VoxelOutput &         volume;
};

/** \class Product
 * \brief What a run makes: an output, or the base of some. It adds what it takes to the plan, sees the run, and is
 * completed at its end. */
class Product
{
public:
  virtual ~Product() = default;

  /** Adds the memory that Start() and what follows will take. */
  virtual void
  AddTo(Footprint &, const VolumeHeader &) const
  {}

  /** Makes what sees the run. */
  virtual void
  Start(ProductStart &)
  {}

  /** Creates its file, when all have started. */
  virtual void
  CreateFile(OutputSet & outputs)
  {
    m_File = outputs.AddFile(this->GetFileName());
  }

  /** A volume that it wants to be filled. */
  virtual std::optional<FilledVolume>
  GetVolume()
  {
    return std::nullopt;
  }

  /** Who sees the tiles of the extraction; null: nobody. */
  virtual itk::MedialVoxelTileObserver *
  GetObserver()
  {
    return nullptr;
  }

  /** The mesh that tells the objects of a label map apart; null: it is another product. */
  virtual SurfaceMesh *
  GetMesh()
  {
    return nullptr;
  }

  /** Hears how walls are measured, before the first piece. */
  virtual void
  UseMeasure(const WallMeasure &)
  {}

  /** Hears the region of each run of the engine. */
  virtual void
  BeginRegion(const itk::MedialVoxelBox &)
  {}

  /** Whether it finds something that one process saves for another. */
  virtual bool
  IsSaved() const
  {
    return false;
  }

  /** Forgets all tiles. */
  virtual void
  Clear()
  {}

  /** What it found, as bytes that any machine reads. */
  virtual std::string
  Save() const
  {
    return {};
  }

  /** Adds what others found, in the order of their slices. \throw JobError Failure when these are not their bytes */
  virtual void
  Merge(const std::string &)
  {}

  /** Makes what needs all pieces, when the volumes are finished. */
  virtual void
  Complete(JobResult &, const ProductEnd &)
  {}

  /** Adds to the complete result; those after it see what it adds. */
  virtual void
  Describe(JobResult &)
  {}

  /** Writes its file, if that has a text. */
  void
  WriteFile(const JobResult & result) const
  {
    if (m_File != nullptr)
    {
      if (const std::optional<std::string> text = this->MakeText(result))
      {
        WriteText(*m_File, *text);
      }
    }
  }

protected:
  /** Empty: none is wanted. */
  virtual std::string
  GetFileName() const
  {
    return {};
  }

  virtual std::optional<std::string>
  MakeText(const JobResult &) const
  {
    return std::nullopt;
  }

  OutputFile * m_File{ nullptr }; ///< null: none is wanted
};

/** In the order in which they start and are completed. */
using ProductList = std::vector<std::unique_ptr<Product>>;

/** All that the products found for others, as bytes. */
std::string
SaveFindings(const ProductList & products);

/** Adds what the same products saved elsewhere, in the order of their slices. \throw JobError Failure when these are
 * not their bytes */
void
MergeFindings(const ProductList & products, const std::string & bytes);

} // end namespace medialvoxel

#endif
