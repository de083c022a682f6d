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
 * \brief Reads any region of a headerless file of uncompressed voxels.
 *
 * RawImageIO reads the whole volume for any request. This class reads only the requested region, so that a pipeline
 * streams. Voxels follow one another, x fastest, from a byte offset on. Offsets are 64 bits wide.
 *
 * Set before use: number of dimensions, dimensions, component type. Set if they differ from the defaults: number of
 * components, HeaderSize, byte order (that of the machine), spacing, origin and direction. The file has no signature,
 * so CanReadFile() is always false; pass the object to ImageFileReader::SetImageIO(). SetSegments() describes voxels
 * in several places or files.
 *
 * It throws exceptions for a file that is missing or unreadable, for a description without component type or with an
 * empty or overflowing size, for a file of another size, and for data that end early. It does not write.
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

  /** Ranges of bytes that make up the volume, one after the other, for voxels in several places or files. They replace
   * file name and HeaderSize; bytes outside of them are not refused. Default: none. */
  void
  SetSegments(const std::vector<MedialVoxelFileSegment> & segments);

  /** Bytes of voxels read since construction, including holes of the file. */
  virtual std::uint64_t
  GetNumberOfBytesRead() const
  {
    return m_Reader.GetNumberOfBytesRead();
  }

  bool
  SupportsDimension(unsigned long dimension) override;

  /** False: raw files have no signature. */
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
