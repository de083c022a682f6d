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
#include <utility>
#include <vector>

namespace medialvoxel
{

class PassCells;
class SheetMesh;
class SheetSurvey;
struct Pictures;

/** The context in which products start. */
struct ProductStart
{
  const JobResult & job;              ///< header and plan
  InputVolume *     input{ nullptr }; ///< null: parts that others found are put together

  // Set by earlier products.
  SheetMesh *         mesh{ nullptr };
  const Survey *      survey{ nullptr };
  const Pictures *    pictures{ nullptr }; ///< they are drawn at the end
  const SheetSurvey * sheet{ nullptr };    ///< of the page, with its view
};

/** The context in which products are completed. */
struct ProductEnd
{
  const OutputSet &           outputs;  ///< whose volumes are finished, but for those that are filled now
  InputVolume *               input;    ///< as at the start
  std::function<void(double)> progress; ///< of the end alone; may throw to stop
};

/** The interfaces of a product that a run serves; null: absent. */
struct ProductLinks
{
  itk::MedialVoxelTileObserver * observer{ nullptr }; ///< sees the tiles of the extraction
  TileSurvey *                   survey{ nullptr };   ///< the same, if it is saved for other processes
  SheetMesh *                    mesh{ nullptr };     ///< separates the objects of a label map
  PassCells *                    cells{ nullptr };    ///< of the passes over a label map
  VolumeRequest *                request{ nullptr };  ///< of a volume that an engine fills
  VoxelOutput *                  volume{ nullptr };   ///< where it goes
};

/** \class Product
 * \brief A result of a run: an output, or the base of several. It adds its memory to the plan, observes the run, and
 * is completed at its end. */
class Product
{
public:
  /** \param fileName empty: no file is wanted */
  explicit Product(std::string fileName)
    : m_FileName(std::move(fileName))
  {}
  virtual ~Product() = default;

  /** Adds the memory of Start() and of the run. */
  virtual void
  AddTo(Footprint &, const VolumeHeader &) const
  {}

  /** Of the progress of a run, about: what Complete() takes. */
  virtual double
  GetShareOfEnd() const
  {
    return 0.0;
  }

  /** Makes the observers of the run. */
  virtual void
  Start(ProductStart &)
  {}

  /** Creates its file, after the start. */
  virtual void
  MakeFile(OutputSet & outputs)
  {
    if (m_Links.request != nullptr && m_Links.volume == nullptr)
    {
      m_Links.volume = &outputs.AddVolume(*m_Links.request);
      return;
    }
    m_File = outputs.AddFile(m_FileName);
  }

  const ProductLinks &
  GetLinks() const
  {
    return m_Links;
  }

  /** Hears how walls are measured, before the first piece. */
  virtual void
  UseMeasure(const WallMeasure &)
  {}

  /** Hears the region of each run of the extraction. */
  virtual void
  BeginRegion(const itk::MedialVoxelBox &)
  {}

  /** Fills volumes that need all pieces, before the volumes are finished. */
  virtual void
  FillVolumes(JobResult &, const ProductEnd &)
  {}

  /** Makes the outputs that need all pieces, when the volumes are finished. */
  virtual void
  Complete(JobResult &, const ProductEnd &)
  {}

  /** Adds to the complete result; later products see the addition. */
  virtual void
  Describe(JobResult &)
  {}

  /** Writes its file, if it is wanted and has a text. */
  void
  WriteFile(const JobResult & result) const
  {
    const std::optional<std::string> text = m_File != nullptr ? this->MakeText(result) : std::nullopt;
    if (text)
    {
      WriteText(*m_File, *text);
    }
  }

protected:
  virtual std::optional<std::string>
  MakeText(const JobResult &) const
  {
    return std::nullopt;
  }

  ProductLinks m_Links;           ///< set at the start
  OutputFile * m_File{ nullptr }; ///< null: none is wanted

private:
  std::string m_FileName;
};

/** In the order in which they start and are completed. */
using ProductList = std::vector<std::unique_ptr<Product>>;

/** All that the products found for others, as bytes. */
std::string
SaveSurveys(const ProductList & products);

/** Merges the saved results of the same products, in the order of their slices. \throw JobError Failure when the
 * bytes do not fit */
void
MergeSurveys(const ProductList & products, const std::string & bytes);

} // end namespace medialvoxel

#endif
