// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef PhantomWriter_h
#define PhantomWriter_h

#include "PhantomShape.h"

#include <cstdio>

namespace phantom
{
enum class PixelType
{
  UInt8,
  UInt16,
  Float32
};

struct OutputParameters
{
  std::string fileName; // .raw (no header), .mha or .nrrd
  PixelType   type{ PixelType::UInt8 };
  double      background{ 0.0 };
  double      object{ 255.0 };
  Vector      spacing{ 1.0, 1.0, 1.0 };
};

/** Writes a volume slab by slab, uncompressed, in the byte order of the machine. */
class VolumeWriter
{
public:
  /** Creates the file and writes its header.
   *  \exception std::invalid_argument on another file extension or values that the pixel type cannot hold.
   *  \exception std::runtime_error when the file cannot be written. */
  VolumeWriter(const OutputParameters & parameters, const Size & size);

  /** Appends whole slices: 1 becomes the object value, 0 the background value.
   *  \exception std::runtime_error when the file cannot be written. */
  void
  Append(const std::vector<unsigned char> & mask);

  /** \exception std::runtime_error when the last bytes cannot be written. */
  void
  Close();

private:
  struct FileCloser
  {
    void
    operator()(std::FILE * file) const
    {
      std::fclose(file);
    }
  };

  template <typename TPixel>
  void
  AppendAs(const std::vector<unsigned char> & mask);

  void
  Write(const void * bytes, std::size_t count);

  [[noreturn]] void
  Fail() const;

  OutputParameters                       m_Parameters;
  std::unique_ptr<std::FILE, FileCloser> m_File;
};
} // namespace phantom

#endif
