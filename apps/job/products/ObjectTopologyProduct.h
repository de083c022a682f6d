// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectTopologyProduct_h
#define medialvoxelObjectTopologyProduct_h

#include "PassCells.h"
#include "Product.h"

#include <optional>

namespace medialvoxel
{

/** \class ObjectTopologyProduct
 * \brief Labels of a label map with cells for the topology of each object, and the objects of all cells: the end of the
 * job reads the cells of one pass after the other. */
class ObjectTopologyProduct : public Product
{
public:
  /** \param labels, objects the volumes that it fills instead of the run */
  ObjectTopologyProduct(const ExtractOptions & options, VolumeRequest labels, std::optional<VolumeRequest> objects);

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override;

  double
  GetShareOfEnd() const override
  {
    return 0.2;
  }

  void
  Start(ProductStart & start) override;

  void
  MakeFile(OutputSet & outputs) override;

  void
  FillVolumes(JobResult & result, const ProductEnd & end) override;

private:
  /** Puts the cells that a pass adds to a slice to the others. */
  void
  TakeAdded(itk::MedialVoxelObjectUnion & united, const itk::MedialVoxelBits & added);

  void
  WriteSlices(std::uint64_t numberOfSlices);

  const ExtractOptions &            m_Options;
  VolumeRequest                     m_Labels;
  std::optional<VolumeRequest>      m_Objects;
  itk::MedialVoxelObjectMap *       m_Map{ nullptr };
  std::optional<PassCells>          m_Cells;
  VoxelOutput *                     m_LabelVolume{ nullptr };
  VoxelOutput *                     m_ObjectVolume{ nullptr };
  itk::MedialVoxelObjectUnion::Sums m_Sums; ///< of the added cells
};

} // end namespace medialvoxel

#endif
