// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkStreamingNrrdImageIO_h
#define itkStreamingNrrdImageIO_h

#include "MedialVoxelExport.h"

#include "itkMedialVoxelSequentialReader.h"
#include "itkStreamingImageIOBase.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace itk
{

struct MedialVoxelNrrdHeader;

/** \class StreamingNrrdImageIO
 * \brief Reads and writes any region of a NRRD file with uncompressed voxels.
 *
 * NrrdImageIO reads the whole volume for any request. This class reads only the requested region and writes a volume
 * piece by piece, so that a pipeline streams. Offsets are 64 bits wide.
 *
 * \par Reading
 * It reads files with `encoding: raw`: attached (.nrrd) and detached (.nhdr), with one data file, a `LIST` of them or a
 * pattern such as `slice%03d.raw 1 40 1`; both byte orders; `line skip` and `byte skip` (-1 included); 2 or 3 axes of
 * space, after at most one axis of components (`kinds: vector domain domain domain`). CanReadFile() is false for all
 * other files, so NrrdImageIO still reads them when StreamingNrrdImageIOFactory is registered in front. Pixels,
 * spacing, origin and direction equal those of NrrdImageIO, with one exception: in the space left-anterior-superior
 * this class reverses the second axis, as the name of the space requires, not the first. The meta-data dictionary gets
 * the key/value pairs, NRRD_space, NRRD_measurement frame, NRRD_content and NRRD_kinds[axis], with the names of
 * NrrdImageIO.
 *
 * \par Writing
 * It writes attached files with `encoding: raw`, in the byte order of the machine. Before the first piece the file has
 * its final size and, with ReserveSpace, its space on the disk. An unfinished file looks like a finished one, so remove
 * it after an exception from upstream. Pieces go into an existing file that has the same header (pasting). Strings of
 * the meta-data dictionary are written as key/value pairs, except those whose key begins with NRRD_.
 *
 * \par Errors
 * Exceptions name the file. Causes: a header that is damaged, hostile or of another kind; data files that are missing
 * or too short; data that end early; a full disk; a request for compression. When writing fails, a file that this
 * object created is removed.
 *
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT StreamingNrrdImageIO : public StreamingImageIOBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(StreamingNrrdImageIO);

  using Self = StreamingNrrdImageIO;
  using Superclass = StreamingImageIOBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(StreamingNrrdImageIO);
#else
  itkTypeMacro(StreamingNrrdImageIO, StreamingImageIOBase);
#endif

  /** Whether a new file takes its space from the disk at once, so that a full disk shows before the first voxel is
   * computed. Off: parts that are never written stay holes. Default true. */
  itkSetMacro(ReserveSpace, bool);
  itkGetConstMacro(ReserveSpace, bool);
  itkBooleanMacro(ReserveSpace);

  /** Bytes of voxels read since construction. */
  std::uint64_t
  GetNumberOfBytesRead() const
  {
    return m_Reader.GetNumberOfBytesRead();
  }

  /** True for 2 and 3. */
  bool
  SupportsDimension(unsigned long dimension) override;

  /** True for .nrrd and .nhdr files of the kind that this class reads, even when they are damaged. */
  bool
  CanReadFile(const char * fileName) override;

  /** Reads and checks the header, and the sizes of the data files. */
  void
  ReadImageInformation() override;

  /** Reads the region set by SetIORegion() and brings its components into the byte order of the machine. */
  void
  Read(void * buffer) override;

  /** True unless compression is asked for. */
  bool
  CanStreamWrite() override;

  /** True for .nrrd. */
  bool
  CanWriteFile(const char * fileName) override;

  /** Creates the file with its header and final size. */
  void
  WriteImageInformation() override;

  /** Writes the region set by SetIORegion(). The whole image, or any region of a file that does not exist, creates the
   * file; other regions go into the existing one. */
  void
  Write(const void * buffer) override;

  /** Number of pieces for the writer. A file to be pasted into must have the same header; a file to be written in
   * pieces is removed. */
  unsigned int
  GetActualNumberOfSplitsForWriting(unsigned int          numberOfRequestedSplits,
                                    const ImageIORegion & pasteRegion,
                                    const ImageIORegion & largestPossibleRegion) override;

protected:
  StreamingNrrdImageIO();
  ~StreamingNrrdImageIO() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  /** Bytes before the voxels of the file that was read or written last. */
  SizeType
  GetHeaderSize() const override;

private:
  void
  ReadMetaData(const MedialVoxelNrrdHeader & header);

  /** The header that a file of this image has. */
  MedialVoxelNrrdHeader
  DescribeImage() const;

  /** Where the voxels lie in an existing file. Throws unless its header is that of this image. */
  MedialVoxelFileSegment
  LocateInExistingFile() const;

  /** Removes a file that this object created, and throws the error. */
  [[noreturn]] void
  RefuseWriting(const std::runtime_error & cause);

  bool                                m_ReserveSpace{ true };
  MedialVoxelSequentialReader         m_Reader;
  std::vector<MedialVoxelFileSegment> m_Segments;
  std::string                         m_CreatedFile;
};

} // end namespace itk

#endif
