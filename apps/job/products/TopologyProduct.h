// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTopologyProduct_h
#define medialvoxelTopologyProduct_h

#include "Product.h"

#include "itkMedialVoxelSameTopology.h"

namespace medialvoxel
{

/** \throw JobError Refused when the slices that wait need more than the plan leaves for them */
void
CheckTopologyMemory(const itk::MedialVoxelSameTopology & topology, const JobPlan & plan);

/** \class TopologyProduct
 * \brief Labels with cells for the topology of the object, which need the whole volume: the run keeps all cells in a
 * scratch file, and the end of the job reads them slice by slice. */
class TopologyProduct : public Product
{
public:
  /** \param labels the volume that it fills instead of the run */
  TopologyProduct(const ExtractOptions & options, VolumeRequest labels);

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override;

  double
  GetShareOfEnd() const override
  {
    return 0.2;
  }

  void
  MakeFile(OutputSet & outputs) override;

  void
  FillVolumes(JobResult & result, const ProductEnd & end) override;

private:
  const ExtractOptions & m_Options;
  VolumeRequest          m_Labels;
  VolumeRequest          m_Cells;
  VoxelOutput *          m_LabelVolume{ nullptr }; ///< null: other processes end the job
};

} // end namespace medialvoxel

#endif
