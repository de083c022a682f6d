// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Binding.h"

#include "ArrayRun.h"
#include "Version.h"

#include "itkMedialVoxelGridLimits.h"
#include "itkMedialVoxelMemoryShortage.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSurfaceObserver.h"

#include <algorithm>
#include <new>
#include <string>
#include <vector>

struct MedialVoxelResult
{
  MedialVoxelStatus      status{ MedialVoxelDone };
  std::string            text;
  medialvoxel::ArrayMesh mesh;
};

namespace medialvoxel
{
namespace
{

static_assert(sizeof(std::atomic<double>) == sizeof(double) && std::atomic<double>::is_always_lock_free,
              "ctypes sees a plain number");

VolumeHeader
MakeHeader(const MedialVoxelArray & array)
{
  VolumeHeader header;
  header.fileName = "array";
  header.pixelType = PixelTypeFromName(array.type).value();
  header.geometry.size.assign(array.size, array.size + 3);
  header.geometry.spacing.assign(array.spacing, array.spacing + 3);
  header.geometry.origin.assign(3, 0.0);
  header.geometry.SetIdentityDirection();
  // Messages count axes as the array does, from the slowest one on.
  std::vector<std::uint64_t> size(array.size, array.size + array.dimension);
  std::vector<double>        spacing(array.spacing, array.spacing + array.dimension);
  std::reverse(size.begin(), size.end());
  std::reverse(spacing.begin(), spacing.end());
  const std::string problem = itk::MedialVoxelGridLimits::FindProblem(size, spacing, std::vector<double>(size.size()));
  if (!problem.empty())
  {
    Fail(ExitStatus::CorruptInput, "array: ", problem);
  }
  return header;
}

/** Sets status and text of what \a work throws. */
template <typename TWork>
void
Guard(MedialVoxelResult & result, TWork && work)
{
  const auto fail = [&result](const MedialVoxelStatus status, const std::string & text) {
    result.status = status;
    result.text = text;
  };
  try
  {
    result.text = work();
  }
  catch (const itk::MedialVoxelAborted &)
  {
    fail(MedialVoxelStopped, "stopped");
  }
  catch (const StoppedBySignal &)
  {
    fail(MedialVoxelStopped, "stopped");
  }
  catch (const itk::MedialVoxelMemoryShortage & error)
  {
    fail(MedialVoxelOutOfMemory, error.what());
  }
  catch (const std::bad_alloc &)
  {
    fail(MedialVoxelOutOfMemory, "out of memory");
  }
  catch (const itk::MedialVoxelSurfacePieceError & error)
  {
    fail(MedialVoxelOutOfMemory, error.what());
  }
  catch (const MemoryRefusal & error)
  {
    fail(MedialVoxelOutOfMemory, error.what());
  }
  catch (const JobError & error)
  {
    fail(error.GetStatus() == ExitStatus::Failure ? MedialVoxelFailed : MedialVoxelWrongValue, error.what());
  }
  catch (const std::exception & error)
  {
    fail(MedialVoxelFailed, error.what());
  }
}

} // namespace
} // end namespace medialvoxel

MedialVoxelResult *
medialvoxel_run(const MedialVoxelArray *   array,
                const char * const *       arguments,
                std::int32_t               numberOfArguments,
                const MedialVoxelOutputs * outputs,
                MedialVoxelControl *       control)
{
  auto * const result = new (std::nothrow) MedialVoxelResult;
  if (result != nullptr)
  {
    medialvoxel::Guard(*result, [&] {
      const medialvoxel::ArrayCall   call{ *array, medialvoxel::MakeHeader(*array), *outputs, *control };
      const std::vector<std::string> words(arguments, arguments + numberOfArguments);
      return medialvoxel::RunArguments(call, words, result->mesh).dump();
    });
  }
  return result;
}

std::int32_t
medialvoxel_status(const MedialVoxelResult * result)
{
  return result->status;
}

const char *
medialvoxel_text(const MedialVoxelResult * result)
{
  return result->text.c_str();
}

void
medialvoxel_mesh(const MedialVoxelResult * result, MedialVoxelMesh * mesh)
{
  const medialvoxel::ArrayMesh & from = result->mesh;
  *mesh = { from.points.data(),
            from.thickness.data(),
            from.faces.data(),
            static_cast<std::int64_t>(from.thickness.size()),
            static_cast<std::int64_t>(from.faces.size()) / from.cornersPerFace,
            from.cornersPerFace };
}

void
medialvoxel_release(MedialVoxelResult * result)
{
  delete result;
}

const char *
medialvoxel_version()
{
  static const std::string version = medialvoxel::GetVersion();
  return version.c_str();
}

std::int64_t
medialvoxel_layout()
{
  return static_cast<std::int64_t>(sizeof(MedialVoxelArray) << 24 | sizeof(MedialVoxelControl) << 16 |
                                   sizeof(MedialVoxelOutputs) << 8 | sizeof(MedialVoxelMesh));
}
