// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomTags_h
#define medialvoxelDicomTags_h

#include <array>
#include <cstdint>

namespace medialvoxel
{

/** Elements whose texts DicomStructure keeps, as group * 65536 + element. */
namespace DicomTag
{

constexpr std::uint32_t SeriesDescription = 0x0008103e;
constexpr std::uint32_t SpacingBetweenSlices = 0x00180088;
constexpr std::uint32_t SeriesInstance = 0x0020000e;
constexpr std::uint32_t AcquisitionNumber = 0x00200012;
constexpr std::uint32_t InstanceNumber = 0x00200013;
constexpr std::uint32_t ImagePosition = 0x00200032;
constexpr std::uint32_t ImageOrientation = 0x00200037;
constexpr std::uint32_t TemporalPosition = 0x00200100;
constexpr std::uint32_t StackId = 0x00209056;
constexpr std::uint32_t FrameTemporalPosition = 0x00209128;
constexpr std::uint32_t FrameAcquisitionNumber = 0x00209156;
constexpr std::uint32_t Interpretation = 0x00280004;
constexpr std::uint32_t NumberOfFrames = 0x00280008;
constexpr std::uint32_t PixelSpacing = 0x00280030;
constexpr std::uint32_t PixelPadding = 0x00280120;
constexpr std::uint32_t PixelPaddingLimit = 0x00280121;
constexpr std::uint32_t RescaleIntercept = 0x00281052;
constexpr std::uint32_t RescaleSlope = 0x00281053;
constexpr std::uint32_t GridFrameOffsets = 0x3004000c;
constexpr std::uint32_t DoseGridScaling = 0x3004000e;

constexpr std::array<std::uint32_t, 20> Texts{
  SeriesDescription,      SpacingBetweenSlices, SeriesInstance,   AcquisitionNumber, InstanceNumber,
  ImagePosition,          ImageOrientation,     TemporalPosition, StackId,           FrameTemporalPosition,
  FrameAcquisitionNumber, Interpretation,       NumberOfFrames,   PixelSpacing,      PixelPadding,
  PixelPaddingLimit,      RescaleIntercept,     RescaleSlope,     GridFrameOffsets,  DoseGridScaling
};

/** Whole numbers, which are kept as texts. */
constexpr std::array<std::uint32_t, 4> Numbers{ FrameTemporalPosition,
                                                FrameAcquisitionNumber,
                                                PixelPadding,
                                                PixelPaddingLimit };

} // namespace DicomTag

} // end namespace medialvoxel

#endif
