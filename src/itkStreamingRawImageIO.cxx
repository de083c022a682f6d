// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkStreamingRawImageIO.h"

#include "itkByteSwapper.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

namespace itk
{
namespace
{

/** Product of the sizes, or -1 when it does not fit the type. */
ImageIOBase::SizeType
CheckedProduct(const std::vector<SizeValueType> & factors)
{
  constexpr SizeValueType limit = std::numeric_limits<ImageIOBase::SizeType>::max();
  SizeValueType           product = 1;
  for (const SizeValueType factor : factors)
  {
    if (factor == 0 || product > limit / factor)
    {
      return -1;
    }
    product *= factor;
  }
  return static_cast<ImageIOBase::SizeType>(product);
}

/** Runs of voxels that lie one after the other both in the file and in the region. */
struct RunLayout
{
  std::vector<ImageIOBase::SizeType> counts;  // number of runs along each axis
  std::vector<ImageIOBase::SizeType> strides; // bytes in the file from one run to the next along each axis
  ImageIOBase::SizeType              start{ 0 };
  ImageIOBase::SizeType              bytesPerRun{ 0 };
};

RunLayout
LayOutRuns(const ImageIOBase & io, const ImageIORegion & region, ImageIOBase::SizeType pixelSize)
{
  RunLayout             layout;
  bool                  contiguous = true;
  ImageIOBase::SizeType stride = pixelSize;
  layout.bytesPerRun = pixelSize;
  for (unsigned int axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
  {
    const bool inRegion = axis < region.GetImageDimension();
    const auto extent = inRegion ? static_cast<ImageIOBase::SizeType>(region.GetSize(axis)) : 1;
    const auto index = inRegion ? static_cast<ImageIOBase::SizeType>(region.GetIndex(axis)) : 0;
    layout.start += index * stride;
    if (contiguous)
    {
      layout.bytesPerRun *= extent;
      contiguous = extent == static_cast<ImageIOBase::SizeType>(io.GetDimensions(axis));
    }
    else
    {
      layout.counts.push_back(extent);
      layout.strides.push_back(stride);
    }
    stride *= static_cast<ImageIOBase::SizeType>(io.GetDimensions(axis));
  }
  return layout;
}

template <typename TUnsigned>
void
SwapRange(void * buffer, std::uint64_t numberOfBytes, bool fileIsBigEndian)
{
  auto * const first = static_cast<TUnsigned *>(buffer);
  const auto   count = static_cast<SizeValueType>(numberOfBytes / sizeof(TUnsigned));
  if (fileIsBigEndian)
  {
    ByteSwapper<TUnsigned>::SwapRangeFromSystemToBigEndian(first, count);
  }
  else
  {
    ByteSwapper<TUnsigned>::SwapRangeFromSystemToLittleEndian(first, count);
  }
}

void
SwapToMachineOrder(void * buffer, std::uint64_t numberOfBytes, unsigned int componentSize, bool fileIsBigEndian)
{
  switch (componentSize)
  {
    case 2:
      return SwapRange<std::uint16_t>(buffer, numberOfBytes, fileIsBigEndian);
    case 4:
      return SwapRange<std::uint32_t>(buffer, numberOfBytes, fileIsBigEndian);
    case 8:
      return SwapRange<unsigned long long>(buffer, numberOfBytes, fileIsBigEndian);
    default:
      return;
  }
}

} // namespace

StreamingRawImageIO::StreamingRawImageIO()
{
  this->SetByteOrder(ByteSwapper<int>::SystemIsBigEndian() ? IOByteOrderEnum::BigEndian
                                                           : IOByteOrderEnum::LittleEndian);
  this->SetPixelType(IOPixelEnum::SCALAR);
  this->SetNumberOfComponents(1);
}

void
StreamingRawImageIO::SetHeaderSize(SizeType numberOfBytes)
{
  if (numberOfBytes < 0)
  {
    itkExceptionMacro("HeaderSize is " << numberOfBytes << " bytes; it must be 0 or more");
  }
  if (m_HeaderSize != numberOfBytes)
  {
    m_HeaderSize = numberOfBytes;
    this->Modified();
  }
}

bool
StreamingRawImageIO::SupportsDimension(unsigned long)
{
  return true;
}

bool
StreamingRawImageIO::CanReadFile(const char *)
{
  return false;
}

void
StreamingRawImageIO::ReadImageInformation()
{
  if (m_ComponentType == IOComponentEnum::UNKNOWNCOMPONENTTYPE)
  {
    itkExceptionMacro("The component type of " << m_FileName << " is not set");
  }
  std::vector<SizeValueType> factors{ this->GetComponentSize(), this->GetNumberOfComponents() };
  for (unsigned int axis = 0; axis < this->GetNumberOfDimensions(); ++axis)
  {
    factors.push_back(this->GetDimensions(axis));
  }
  const SizeType dataSize = CheckedProduct(factors);
  if (dataSize < 0 || dataSize > std::numeric_limits<SizeType>::max() - m_HeaderSize)
  {
    itkExceptionMacro("The size described for " << m_FileName << " is empty or overflows");
  }

  std::ifstream file(m_FileName, std::ios::binary | std::ios::ate);
  const auto    fileSize = static_cast<SizeType>(file.tellg());
  if (!file.is_open() || fileSize < 0)
  {
    itkExceptionMacro("Cannot open " << m_FileName << ": " << std::strerror(errno));
  }
  const SizeType expected = m_HeaderSize + dataSize;
  if (fileSize < expected || (m_RefuseTrailingBytes && fileSize > expected))
  {
    itkExceptionMacro(<< m_FileName << " has " << fileSize << " bytes; its description needs "
                      << (m_RefuseTrailingBytes ? "" : "at least ") << expected << " (" << m_HeaderSize
                      << " before the voxels, " << dataSize << " of voxels)");
  }
}

void
StreamingRawImageIO::Read(void * buffer)
{
  std::ifstream file;
  // Unbuffered, so that a short run does not read a stream buffer full.
  file.rdbuf()->pubsetbuf(nullptr, 0);
  file.open(m_FileName, std::ios::binary);
  if (!file.is_open())
  {
    itkExceptionMacro("Cannot open " << m_FileName << ": " << std::strerror(errno));
  }

  const SizeType  pixelSize = static_cast<SizeType>(this->GetComponentSize()) * this->GetNumberOfComponents();
  const RunLayout layout = LayOutRuns(*this, this->GetIORegion(), pixelSize);
  SizeType        numberOfRuns = 1;
  for (const SizeType count : layout.counts)
  {
    numberOfRuns *= count;
  }

  auto * destination = static_cast<char *>(buffer);
  for (SizeType run = 0; run < numberOfRuns; ++run)
  {
    SizeType offset = m_HeaderSize + layout.start;
    SizeType rest = run;
    for (size_t axis = 0; axis < layout.counts.size(); ++axis)
    {
      offset += (rest % layout.counts[axis]) * layout.strides[axis];
      rest /= layout.counts[axis];
    }
    file.seekg(offset, std::ios::beg);
    if (!file.good() || !this->ReadBufferAsBinary(file, destination, layout.bytesPerRun))
    {
      itkExceptionMacro("Cannot read " << layout.bytesPerRun << " bytes at offset " << offset << " of " << m_FileName
                                       << ": the file ends early or the device fails");
    }
    destination += layout.bytesPerRun;
  }

  const auto numberOfBytes = static_cast<std::uint64_t>(numberOfRuns * layout.bytesPerRun);
  m_NumberOfBytesRead += numberOfBytes;
  SwapToMachineOrder(
    buffer, numberOfBytes, this->GetComponentSize(), this->GetByteOrder() == IOByteOrderEnum::BigEndian);
}

bool
StreamingRawImageIO::CanStreamWrite()
{
  return false;
}

bool
StreamingRawImageIO::CanWriteFile(const char *)
{
  return false;
}

void
StreamingRawImageIO::WriteImageInformation()
{
  itkExceptionMacro("StreamingRawImageIO only reads");
}

void
StreamingRawImageIO::Write(const void *)
{
  itkExceptionMacro("StreamingRawImageIO only reads");
}

void
StreamingRawImageIO::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "HeaderSize: " << m_HeaderSize << std::endl;
  os << indent << "RefuseTrailingBytes: " << m_RefuseTrailingBytes << std::endl;
  os << indent << "NumberOfBytesRead: " << m_NumberOfBytesRead << std::endl;
}

} // end namespace itk
