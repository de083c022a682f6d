// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "MaskInput.h"
#include "ObjectValues.h"
#include "ValueReader.h"

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelProgress.h"

#include <vector>

namespace medialvoxel
{
namespace
{

/** Between labels there are no values: not without a threshold, and not with one value for both. A label has no
 * thresholds. */
Interpolation
GetInterpolation(const JobOptions & options)
{
  const bool hasThreshold = options.lowerThreshold || options.upperThreshold;
  return hasThreshold && options.lowerThreshold != options.upperThreshold ? Interpolation::Linear
                                                                          : Interpolation::Nearest;
}

/** \class StreamedInput
 * \brief Reads the boxes that it is asked for. */
class StreamedInput : public InputVolume
{
public:
  StreamedInput(const VolumeHeader & header, const JobOptions & options)
    : InputVolume(GetTraits(header.pixelType).bytes)
    , m_Type(header.pixelType)
    , m_Options(options)
    , m_Reader(MakeValueReader(header, GetInterpolation(options)))
  {}

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Reader->GetNumberOfBytesRead();
  }

protected:
  void
  FillPart(const itk::MedialVoxelBox & part, const VoxelTargets & targets) override
  {
    m_Values.resize(static_cast<std::size_t>(part.NumberOfVoxels()) * GetTraits(m_Type).bytes);
    this->MeasureReading([&] { m_Reader->Read(part, m_Values.data()); });
    DispatchPixelType(
      m_Type, [&](auto zero) { this->Pack(reinterpret_cast<const decltype(zero) *>(m_Values.data()), part, targets); });
  }

private:
  template <typename TValue>
  void
  Pack(const TValue * values, const itk::MedialVoxelBox & part, const VoxelTargets & targets) const
  {
    const itk::MedialVoxelStrides strides{ 1, part.Extent(0), part.Extent(0) * part.Extent(1) };
    if (targets.object != nullptr)
    {
      itk::MedialVoxelPackBox(values, strides, part, MakeObjectPredicate<TValue>(m_Options), *targets.object);
    }
    if (targets.notANumber != nullptr)
    {
      itk::MedialVoxelPackBox(values, strides, part, [](TValue value) { return value != value; }, *targets.notANumber);
    }
    if (targets.gray != nullptr)
    {
      itk::MedialVoxelCopyBox(values, strides, part, *targets.gray);
    }
  }

  PixelType                    m_Type;
  JobOptions                   m_Options;
  std::unique_ptr<ValueReader> m_Reader;
  std::vector<std::byte>       m_Values; ///< of a part
};

} // namespace

void
InputVolume::Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets)
{
  for (const itk::MedialVoxelBox & part : itk::MedialVoxelEngineClient::CutForPull(box, m_BytesPerVoxel))
  {
    itk::MedialVoxelPoll();
    this->FillPart(part, targets);
  }
}

std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header, const JobOptions & options, const std::filesystem::path & scratchFolder)
{
  if (header.CanStream())
  {
    return std::make_unique<StreamedInput>(header, options);
  }
  return OpenMaskInput(header, options, GetInterpolation(options), scratchFolder);
}

} // end namespace medialvoxel
