// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "RawImageIO.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class CheckedRawImageIO
 * \brief Reports voxels that a file lost after its header was read as corrupt input. */
class CheckedRawImageIO : public itk::StreamingRawImageIO
{
public:
  using Self = CheckedRawImageIO;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  void
  SetNeededFileSizes(const std::map<std::filesystem::path, std::uint64_t> & sizes)
  {
    m_NeededFileSizes = sizes;
  }

  void
  ReadImageInformation() override
  {
    this->Check([this] { StreamingRawImageIO::ReadImageInformation(); });
  }

  void
  Read(void * buffer) override
  {
    this->Check([this, buffer] { StreamingRawImageIO::Read(buffer); });
  }

private:
  template <typename TFunction>
  void
  Check(TFunction && read) const
  try
  {
    read();
  }
  catch (const itk::ExceptionObject & error)
  {
    if (this->IsCut())
    {
      Fail(ExitStatus::CorruptInput, RemoveOrigin(error.GetDescription()));
    }
    throw;
  }

  bool
  IsCut() const
  {
    return std::any_of(m_NeededFileSizes.begin(), m_NeededFileSizes.end(), [](const auto & needed) {
      std::error_code unknown;
      const auto      size = std::filesystem::file_size(needed.first, unknown);
      return !unknown && size < needed.second;
    });
  }

  std::map<std::filesystem::path, std::uint64_t> m_NeededFileSizes;
};

} // namespace

itk::StreamingRawImageIO::Pointer
MakeRawImageIO(const VolumeHeader & header)
{
  const auto imageIO = CheckedRawImageIO::New();
  imageIO->SetNeededFileSizes(GetNeededFileSizes(header));
  return imageIO.GetPointer();
}

} // end namespace medialvoxel
