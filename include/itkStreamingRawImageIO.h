// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkStreamingRawImageIO_h
#define itkStreamingRawImageIO_h

#include "MedialVoxelExport.h"

#include "itkMedialVoxelSequentialReader.h"
#include "itkStreamingImageIOBase.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class StreamingRawImageIO
 * \brief Reads any region of a file of uncompressed voxels that describes itself nowhere.
 *
 * Where RawImageIO reads the whole volume for any request, this class reads the requested region and nothing else,
 * so that a pipeline streams. Voxels lie x fastest, one after the other, from a byte offset on; offsets are 64 bits
 * wide. Before use set the number of dimensions, the dimensions, the component type and, where they differ from the
 * defaults, the number of components, HeaderSize, the byte order (default: that of the machine), spacing, origin and
 * direction. Such a file has no signature: CanReadFile() is false for all files, and the object has to be handed to
 * the reader with ImageFileReader::SetImageIO(). Voxels that lie in several places, or in several files, are described
 * by SetSegments().
 *
 * Errors are exceptions: a file that is missing or unreadable, a description without component type or with an empty
 * or overflowing size, a file whose size does not fit the description, data that end early. Writing is not offered.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT StreamingRawImageIO : public StreamingImageIOBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(StreamingRawImageIO);

  using Self = StreamingRawImageIO;
  using Superclass = StreamingImageIOBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(StreamingRawImageIO);
#else
  itkTypeMacro(StreamingRawImageIO, StreamingImageIOBase);
#endif

  /** Bytes before the first voxel, 0 or more. Default 0. */
  void
  SetHeaderSize(SizeType numberOfBytes);
  SizeType
  GetHeaderSize() const override
  {
    return m_HeaderSize;
  }

  /** Whether bytes after the last voxel are refused. Default true. */
  itkSetMacro(RefuseTrailingBytes, bool);
  itkGetConstMacro(RefuseTrailingBytes, bool);
  itkBooleanMacro(RefuseTrailingBytes);

  /** Where the voxels lie when they do not follow each other in the file: stretches of bytes which make up the volume
   * one after the other. They take the place of file name and HeaderSize, and bytes beside them are not refused.
   * Default: none. */
  void
  SetSegments(const std::vector<MedialVoxelFileSegment> & segments);

  /** Bytes of voxels handed out since construction; those of holes in the file count. */
  virtual std::uint64_t
  GetNumberOfBytesRead() const
  {
    return m_Reader.GetNumberOfBytesRead();
  }

  bool
  SupportsDimension(unsigned long dimension) override;

  /** False: such files have no signature. */
  bool
  CanReadFile(const char * fileName) override;

  /** Checks the description against the size of the file. */
  void
  ReadImageInformation() override;

  /** Reads the region set by SetIORegion() and brings its components into the byte order of the machine. */
  void
  Read(void * buffer) override;

  bool
  CanStreamWrite() override;
  bool
  CanWriteFile(const char * fileName) override;
  void
  WriteImageInformation() override;
  /** Throws: this class only reads. */
  void
  Write(const void * buffer) override;

protected:
  StreamingRawImageIO();
  ~StreamingRawImageIO() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  void
  CheckFile(SizeType dataSize) const;

  void
  CheckSegments(SizeType dataSize) const;

  SizeType                            m_HeaderSize{ 0 };
  bool                                m_RefuseTrailingBytes{ true };
  MedialVoxelSequentialReader         m_Reader;
  std::vector<MedialVoxelFileSegment> m_Segments;
};

} // end namespace itk

#endif
