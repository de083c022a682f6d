// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkStreamingNrrdImageIO.h"

#include "itkIOCommon.h"
#include "itkMedialVoxelHeaderText.h"
#include "itkMedialVoxelNrrdHeader.h"
#include "itkMedialVoxelText.h"
#include "itkMetaDataObject.h"
#include "itkStreamingImageIORegion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace itk
{
namespace
{

constexpr const char * FieldPrefix = "NRRD_";

constexpr std::array<std::pair<const char *, IOComponentEnum>, 12> ComponentTypes{ {
  { "uint8", IOComponentEnum::UCHAR },
  { "int8", IOComponentEnum::CHAR },
  { "uint16", IOComponentEnum::USHORT },
  { "int16", IOComponentEnum::SHORT },
  { "uint32", IOComponentEnum::UINT },
  { "int32", IOComponentEnum::INT },
  { "uint64", IOComponentEnum::ULONGLONG },
  { "int64", IOComponentEnum::LONGLONG },
  { "float32", IOComponentEnum::FLOAT },
  { "float64", IOComponentEnum::DOUBLE },
  { sizeof(long) == 4 ? "uint32" : "uint64", IOComponentEnum::ULONG },
  { sizeof(long) == 4 ? "int32" : "int64", IOComponentEnum::LONG },
} };

// The first kind of a pixel type is the one written; every kind that is not listed is read as a vector.
constexpr std::array<std::pair<const char *, IOPixelEnum>, 14> PixelKinds{ {
  { "RGB-color", IOPixelEnum::RGB },
  { "3-color", IOPixelEnum::RGB },
  { "RGBA-color", IOPixelEnum::RGBA },
  { "4-color", IOPixelEnum::RGBA },
  { "point", IOPixelEnum::POINT },
  { "covariant-vector", IOPixelEnum::COVARIANTVECTOR },
  { "normal", IOPixelEnum::COVARIANTVECTOR },
  { "3-gradient", IOPixelEnum::COVARIANTVECTOR },
  { "3-normal", IOPixelEnum::COVARIANTVECTOR },
  { "3D-symmetric-matrix", IOPixelEnum::SYMMETRICSECONDRANKTENSOR },
  { "complex", IOPixelEnum::COMPLEX },
  { "scalar", IOPixelEnum::SCALAR },
  { "stub", IOPixelEnum::SCALAR },
  { "3D-symmetric-matrix", IOPixelEnum::DIFFUSIONTENSOR3D },
} };

IOPixelEnum
PixelTypeOfKind(const std::string & kind)
{
  const auto found =
    std::find_if(PixelKinds.begin(), PixelKinds.end(), [&kind](const auto & entry) { return kind == entry.first; });
  const IOPixelEnum other = kind.empty() ? IOPixelEnum::SCALAR : IOPixelEnum::VECTOR;
  return found == PixelKinds.end() ? other : found->second;
}

std::string
KindOfPixelType(IOPixelEnum type, unsigned int components)
{
  if (components == 1)
  {
    return {};
  }
  const auto found =
    std::find_if(PixelKinds.begin(), PixelKinds.end(), [type](const auto & entry) { return type == entry.second; });
  const std::string kind = found == PixelKinds.end() || type == IOPixelEnum::SCALAR ? "vector" : found->first;
  // The format ties this kind to 6 components.
  return kind == "3D-symmetric-matrix" && components != 6 ? "vector" : kind;
}

/** Equal within the rounding of the product of spacing and direction. */
bool
AreClose(const std::vector<double> & first, const std::vector<double> & second)
{
  constexpr double tolerance = 1e-12;
  return std::equal(first.begin(), first.end(), second.begin(), second.end(), [](double a, double b) {
    return std::abs(a - b) <= tolerance * std::max({ 1.0, std::abs(a), std::abs(b) });
  });
}

} // namespace

StreamingNrrdImageIO::StreamingNrrdImageIO()
{
  this->SetNumberOfDimensions(3);
  this->AddSupportedReadExtension(".nrrd");
  this->AddSupportedReadExtension(".nhdr");
  this->AddSupportedWriteExtension(".nrrd");
}

bool
StreamingNrrdImageIO::SupportsDimension(unsigned long dimension)
{
  return dimension == 2 || dimension == 3;
}

bool
StreamingNrrdImageIO::CanReadFile(const char * fileName)
{
  using MedialVoxelText::HeaderError;
  if (!this->HasSupportedReadExtension(fileName))
  {
    return false;
  }
  try
  {
    const std::string encoding = FindMedialVoxelNrrdEncoding(fileName);
    if (!encoding.empty() && encoding != "raw")
    {
      return false;
    }
    ReadMedialVoxelNrrdHeader(fileName);
  }
  catch (const HeaderError & error)
  {
    // A damaged header is accepted here, so that reading can report its error.
    return error.GetKind() == HeaderError::Kind::Corrupt;
  }
  return true;
}

void
StreamingNrrdImageIO::ReadImageInformation()
{
  m_Segments.clear();
  try
  {
    const MedialVoxelNrrdHeader header = ReadMedialVoxelNrrdHeader(m_FileName);
    if (header.encoding != "raw")
    {
      itkExceptionMacro(<< m_FileName << ": encoding is '" << header.encoding << "'; only raw is read");
    }
    const auto component = std::find_if(ComponentTypes.begin(), ComponentTypes.end(), [&header](const auto & entry) {
      return header.componentType == entry.first;
    });
    this->SetComponentType(component->second);
    this->SetPixelType(PixelTypeOfKind(header.componentKind));
    this->SetNumberOfComponents(static_cast<unsigned int>(header.numberOfComponents));
    this->SetFileTypeToBinary();
    const auto byteOrder = header.bigEndian ? IOByteOrderEnum::BigEndian : IOByteOrderEnum::LittleEndian;
    this->SetByteOrder(header.bytesPerComponent == 1 ? IOByteOrderEnum::OrderNotApplicable : byteOrder);

    const auto dimension = static_cast<unsigned int>(header.size.size());
    this->SetNumberOfDimensions(dimension);
    for (unsigned int axis = 0; axis < dimension; ++axis)
    {
      this->SetDimensions(axis, static_cast<SizeValueType>(header.size[axis]));
      this->SetSpacing(axis, header.spacing[axis]);
      this->SetOrigin(axis, header.origin[axis]);
      this->SetDirection(axis, header.direction[axis]);
    }
    this->ReadMetaData(header);
    m_Segments = LocateMedialVoxelNrrdVoxels(header);
  }
  catch (const MedialVoxelText::HeaderError & error)
  {
    itkExceptionMacro(<< error.what());
  }
}

void
StreamingNrrdImageIO::ReadMetaData(const MedialVoxelNrrdHeader & header)
{
  MetaDataDictionary & dictionary = this->GetMetaDataDictionary();
  const std::string    prefix = FieldPrefix;
  dictionary.Clear();
  EncapsulateMetaData<std::string>(dictionary, ITK_InputFilterName, this->GetNameOfClass());
  for (const auto & [key, value] : header.keyValues)
  {
    EncapsulateMetaData<std::string>(dictionary, key, value);
  }
  if (!header.space.empty())
  {
    EncapsulateMetaData<std::string>(dictionary, prefix + "space", header.space);
  }
  const auto content = header.fields.find("content");
  if (content != header.fields.end() && !content->second.empty())
  {
    EncapsulateMetaData<std::string>(dictionary, prefix + "content", content->second);
  }
  if (!header.measurementFrame.empty())
  {
    EncapsulateMetaData<std::vector<std::vector<double>>>(
      dictionary, prefix + "measurement frame", header.measurementFrame);
  }
  const auto kinds = header.fields.find("kinds");
  if (kinds != header.fields.end())
  {
    const std::vector<std::string> names = MedialVoxelText::SplitAtBlanks(kinds->second);
    const size_t                   first = names.size() - header.size.size();
    for (size_t axis = 0; axis < header.size.size(); ++axis)
    {
      EncapsulateMetaData<std::string>(dictionary, prefix + "kinds[" + std::to_string(axis) + "]", names[first + axis]);
    }
  }
}

void
StreamingNrrdImageIO::Read(void * buffer)
{
  const MedialVoxelFileRegion region = MakeFileRegion(*this);
  try
  {
    m_Reader.Read(region, m_Segments, buffer);
  }
  catch (const std::runtime_error & error)
  {
    itkExceptionMacro(<< m_FileName << ": " << error.what());
  }
  if ((this->GetByteOrder() == IOByteOrderEnum::BigEndian) != MachineIsBigEndian())
  {
    SwapComponentBytes(buffer, region.GetNumberOfBytes(), this->GetComponentSize());
  }
}

bool
StreamingNrrdImageIO::CanStreamWrite()
{
  return !this->GetUseCompression();
}

bool
StreamingNrrdImageIO::CanWriteFile(const char * fileName)
{
  return this->HasSupportedWriteExtension(fileName);
}

unsigned int
StreamingNrrdImageIO::GetActualNumberOfSplitsForWriting(unsigned int          numberOfRequestedSplits,
                                                        const ImageIORegion & pasteRegion,
                                                        const ImageIORegion & largestPossibleRegion)
{
  if (!this->CanStreamWrite())
  {
    return ImageIOBase::GetActualNumberOfSplitsForWriting(numberOfRequestedSplits, pasteRegion, largestPossibleRegion);
  }
  if (std::filesystem::exists(m_FileName))
  {
    if (pasteRegion != largestPossibleRegion)
    {
      this->LocateInExistingFile();
    }
    else if (numberOfRequestedSplits != 1)
    {
      // Otherwise the first piece would be taken for one to paste.
      std::error_code error;
      if (!std::filesystem::remove(m_FileName, error))
      {
        itkExceptionMacro("Cannot replace " << m_FileName << ": " << error.message());
      }
    }
  }
  return this->GetActualNumberOfSplitsForWritingCanStreamWrite(numberOfRequestedSplits, pasteRegion);
}

MedialVoxelNrrdHeader
StreamingNrrdImageIO::DescribeImage() const
{
  const auto component = std::find_if(ComponentTypes.begin(), ComponentTypes.end(), [this](const auto & entry) {
    return entry.second == m_ComponentType;
  });
  if (component == ComponentTypes.end())
  {
    itkExceptionMacro("Cannot write " << m_FileName << ": the component type "
                                      << ImageIOBase::GetComponentTypeAsString(m_ComponentType)
                                      << " is not one of NRRD");
  }
  MedialVoxelNrrdHeader header;
  header.fileName = m_FileName;
  header.componentType = component->first;
  header.bytesPerComponent = this->GetComponentSize();
  header.bigEndian = MachineIsBigEndian();
  header.encoding = "raw";
  header.componentKind = KindOfPixelType(this->GetPixelType(), this->GetNumberOfComponents());
  header.numberOfComponents = this->GetNumberOfComponents();
  std::vector<std::uint64_t> factors{ header.bytesPerComponent, header.numberOfComponents };
  for (unsigned int axis = 0; axis < this->GetNumberOfDimensions(); ++axis)
  {
    factors.push_back(this->GetDimensions(axis));
    header.size.push_back(this->GetDimensions(axis));
    header.spacing.push_back(this->GetSpacing(axis));
    header.origin.push_back(this->GetOrigin(axis));
    header.direction.push_back(this->GetDirection(axis));
  }
  if (header.size.size() < 2 || header.size.size() > 3 || CheckedFileSize(factors) == 0)
  {
    itkExceptionMacro("Cannot write " << m_FileName << ": it must have 2 or 3 dimensions, not " << header.size.size()
                                      << ", and neither be empty nor overflow 64 bits");
  }
  const MetaDataDictionary & dictionary = this->GetMetaDataDictionary();
  for (const std::string & key : dictionary.GetKeys())
  {
    std::string value;
    if (key.rfind(FieldPrefix, 0) != 0 && ExposeMetaData<std::string>(dictionary, key, value))
    {
      header.keyValues[key] = value;
    }
  }
  return header;
}

MedialVoxelFileSegment
StreamingNrrdImageIO::LocateInExistingFile() const
{
  const MedialVoxelNrrdHeader image = this->DescribeImage();
  MedialVoxelNrrdHeader       file;
  MedialVoxelFileSegment      segment;
  try
  {
    file = ReadMedialVoxelNrrdHeader(m_FileName);
    segment = LocateMedialVoxelNrrdVoxels(file).front();
  }
  catch (const MedialVoxelText::HeaderError & error)
  {
    itkExceptionMacro("Cannot write a part of an existing file: " << error.what());
  }
  std::string difference;
  const auto  compare = [&difference](bool isEqual, const char * what) {
    difference += isEqual ? std::string() : (difference.empty() ? "" : ", ") + std::string(what);
  };
  compare(file.IsAttached() && file.encoding == "raw", "encoding or data file");
  compare(file.componentType == image.componentType, "type");
  compare(file.numberOfComponents == image.numberOfComponents, "number of components");
  compare(file.bytesPerComponent == 1 || file.bigEndian == image.bigEndian, "byte order");
  compare(file.size == image.size, "sizes");
  if (difference.empty())
  {
    compare(AreClose(file.spacing, image.spacing), "spacing");
    compare(AreClose(file.origin, image.origin), "origin");
    for (size_t axis = 0; axis < image.size.size(); ++axis)
    {
      compare(AreClose(file.direction[axis], image.direction[axis]), "direction");
    }
  }
  if (!difference.empty())
  {
    itkExceptionMacro("Cannot write a part of " << m_FileName << ", which differs from the image in: " << difference);
  }
  return segment;
}

void
StreamingNrrdImageIO::WriteImageInformation()
{
  if (this->GetUseCompression())
  {
    itkExceptionMacro("Cannot write " << m_FileName
                                      << " compressed: switch UseCompression off, or hand NrrdImageIO to the writer");
  }
  const MedialVoxelNrrdHeader header = this->DescribeImage();
  const std::string           text = MakeMedialVoxelNrrdText(header);
  MedialVoxelFileSegment      segment{ m_FileName, text.size(), header.GetNumberOfBytes() };
  try
  {
    CreateFileOfSize(m_FileName, segment.offset + segment.numberOfBytes, m_ReserveSpace);
    m_CreatedFile = m_FileName;
    MedialVoxelFileRegion({ text.size() }, { 0 }, { text.size() }, 1)
      .Write({ m_FileName, 0, text.size() }, text.data());
  }
  catch (const std::runtime_error & error)
  {
    this->RefuseWriting(error);
  }
  m_Segments = { segment };
}

void
StreamingNrrdImageIO::Write(const void * buffer)
{
  if (this->RequestedToStream() && std::filesystem::exists(m_FileName))
  {
    m_Segments = { this->LocateInExistingFile() };
  }
  else
  {
    this->WriteImageInformation();
  }
  try
  {
    MakeFileRegion(*this).Write(m_Segments.front(), buffer);
  }
  catch (const std::runtime_error & error)
  {
    this->RefuseWriting(error);
  }
}

void
StreamingNrrdImageIO::RefuseWriting(const std::runtime_error & cause)
{
  // An unfinished file would look like a finished one.
  if (m_CreatedFile == m_FileName)
  {
    std::error_code ignored;
    std::filesystem::remove(m_FileName, ignored);
    m_CreatedFile.clear();
  }
  itkExceptionMacro(<< cause.what());
}

StreamingNrrdImageIO::SizeType
StreamingNrrdImageIO::GetHeaderSize() const
{
  return m_Segments.empty() ? 0 : static_cast<SizeType>(m_Segments.front().offset);
}

void
StreamingNrrdImageIO::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "ReserveSpace: " << m_ReserveSpace << std::endl;
  os << indent << "NumberOfBytesRead: " << m_Reader.GetNumberOfBytesRead() << std::endl;
  os << indent << "NumberOfDataFiles: " << m_Segments.size() << std::endl;
  os << indent << "CreatedFile: " << m_CreatedFile << std::endl;
}

} // end namespace itk
