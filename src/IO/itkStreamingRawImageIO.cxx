// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkStreamingRawImageIO.h"

#include "itkStreamingImageIORegion.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <vector>

namespace itk
{
namespace
{

ImageIOBase::SizeType
GetFileSize(const std::filesystem::path & fileName)
{
  std::ifstream file(fileName, std::ios::binary | std::ios::ate);
  const auto    size = static_cast<ImageIOBase::SizeType>(file.tellg());
  if (!file.is_open() || size < 0)
  {
    itkGenericExceptionMacro("Cannot open " << fileName.string() << ": " << std::strerror(errno));
  }
  return size;
}

} // namespace

StreamingRawImageIO::StreamingRawImageIO()
{
  this->SetByteOrder(MachineIsBigEndian() ? IOByteOrderEnum::BigEndian : IOByteOrderEnum::LittleEndian);
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

void
StreamingRawImageIO::SetSegments(const std::vector<MedialVoxelFileSegment> & segments)
{
  m_Segments = segments;
  this->Modified();
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
  std::vector<std::uint64_t> factors{ this->GetComponentSize(), this->GetNumberOfComponents() };
  for (unsigned int axis = 0; axis < this->GetNumberOfDimensions(); ++axis)
  {
    factors.push_back(this->GetDimensions(axis));
  }
  const auto dataSize = static_cast<SizeType>(CheckedFileSize(factors));
  if (dataSize == 0 || dataSize > std::numeric_limits<SizeType>::max() - m_HeaderSize)
  {
    itkExceptionMacro("The size described for " << m_FileName << " is empty or overflows");
  }

  if (m_Segments.empty())
  {
    this->CheckFile(dataSize);
  }
  else
  {
    this->CheckSegments(dataSize);
  }
}

void
StreamingRawImageIO::CheckFile(SizeType dataSize) const
{
  const SizeType fileSize = GetFileSize(m_FileName);
  const SizeType expected = m_HeaderSize + dataSize;
  if (fileSize < expected || (m_RefuseTrailingBytes && fileSize > expected))
  {
    itkExceptionMacro(<< m_FileName << " has " << fileSize << " bytes; its description needs "
                      << (m_RefuseTrailingBytes ? "" : "at least ") << expected << " (" << m_HeaderSize
                      << " before the voxels, " << dataSize << " of voxels)");
  }
}

void
StreamingRawImageIO::CheckSegments(SizeType dataSize) const
{
  std::uint64_t sum = 0;
  for (const MedialVoxelFileSegment & segment : m_Segments)
  {
    const auto fileSize = static_cast<std::uint64_t>(GetFileSize(segment.fileName));
    if (fileSize < segment.offset || fileSize - segment.offset < segment.numberOfBytes)
    {
      itkExceptionMacro(<< segment.fileName.string() << " has " << fileSize << " bytes; its description needs "
                        << segment.numberOfBytes << " after " << segment.offset);
    }
    sum += segment.numberOfBytes;
  }
  if (sum != static_cast<std::uint64_t>(dataSize))
  {
    itkExceptionMacro("The segments of " << m_FileName << " have " << sum << " bytes; its description needs "
                                         << dataSize);
  }
}

void
StreamingRawImageIO::Read(void * buffer)
{
  const MedialVoxelFileRegion  region = MakeFileRegion(*this);
  const std::uint64_t          toTheEnd = std::numeric_limits<SizeType>::max();
  const MedialVoxelFileSegment whole{ m_FileName, static_cast<std::uint64_t>(m_HeaderSize), toTheEnd };
  try
  {
    m_Reader.Read(region, m_Segments.empty() ? std::vector<MedialVoxelFileSegment>{ whole } : m_Segments, buffer);
  }
  catch (const std::runtime_error & error)
  {
    itkExceptionMacro(<< error.what());
  }
  if ((this->GetByteOrder() == IOByteOrderEnum::BigEndian) != MachineIsBigEndian())
  {
    SwapComponentBytes(buffer, region.GetNumberOfBytes(), this->GetComponentSize());
  }
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
  os << indent << "NumberOfBytesRead: " << m_Reader.GetNumberOfBytesRead() << std::endl;
  os << indent << "NumberOfSegments: " << m_Segments.size() << std::endl;
}

} // end namespace itk
