// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValueStream_h
#define medialvoxelValueStream_h

#include "InputVolume.h"
#include "VoxelStream.h"

#include "itkByteSwapper.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace medialvoxel
{

template <typename TPixel>
void
SwapToMachineOrder(std::vector<TPixel> & pixels, bool fileIsBigEndian)
{
  if (fileIsBigEndian)
  {
    itk::ByteSwapper<TPixel>::SwapRangeFromSystemToBigEndian(pixels.data(), pixels.size());
  }
  else
  {
    itk::ByteSwapper<TPixel>::SwapRangeFromSystemToLittleEndian(pixels.data(), pixels.size());
  }
}

template <typename TPixel>
std::vector<double>
ScaleValues(const std::vector<TPixel> & pixels, const ValueScale & scale)
{
  std::vector<double> values(pixels.size());
  std::transform(pixels.begin(), pixels.end(), values.begin(), [&scale](TPixel pixel) {
    return scale.slope * static_cast<double>(pixel) + scale.intercept;
  });
  return values;
}

/** Calls function(T{}) with the type of the values: double for scaled ones, otherwise that of the numbers in the file.
 */
template <typename TFunction>
auto
DispatchValueType(const VolumeHeader & header, TFunction && function)
{
  return DispatchPixelType(header.scale ? PixelType::Float64 : header.pixelType, function);
}

/** Voxels that follow each other and are read at once. The mask of packed volumes needs whole words of them. */
constexpr std::uint64_t VoxelsPerChunk = std::uint64_t{ 1 } << 17;

/** Calls function(vector) for the numbers of a volume that does not stream, chunk by chunk from front to back.
 * \return bytes read
 * \throw JobError CorruptInput when packed voxels are damaged or end early; what the observer throws */
template <typename TPixel, typename TFunction>
std::uint64_t
StreamNumbers(const VolumeHeader & header, const ReadObserver & observer, TFunction && function)
{
  const std::uint64_t                numberOfVoxels = header.geometry.GetNumberOfVoxels();
  std::vector<TPixel>                pixels;
  const std::unique_ptr<VoxelStream> stream = OpenVoxelStream(header);
  for (std::uint64_t voxel = 0; voxel < numberOfVoxels; voxel += VoxelsPerChunk)
  {
    observer(static_cast<double>(voxel) / static_cast<double>(numberOfVoxels));
    pixels.resize(std::min(VoxelsPerChunk, numberOfVoxels - voxel));
    stream->Read(pixels.data(), pixels.size() * sizeof(TPixel));
    SwapToMachineOrder(pixels, header.bigEndian);
    function(pixels);
  }
  stream->CheckEnd();
  return stream->GetNumberOfBytesRead();
}

/** The same for its values, of a type that DispatchValueType() gives. */
template <typename TValue, typename TFunction>
std::uint64_t
StreamValues(const VolumeHeader & header, const ReadObserver & observer, TFunction && function)
{
  if constexpr (std::is_same<TValue, double>::value)
  {
    if (header.scale)
    {
      return DispatchPixelType(header.pixelType, [&](auto zero) {
        return StreamNumbers<decltype(zero)>(
          header, observer, [&](const auto & numbers) { function(ScaleValues(numbers, *header.scale)); });
      });
    }
  }
  return StreamNumbers<TValue>(header, observer, function);
}

} // end namespace medialvoxel

#endif
