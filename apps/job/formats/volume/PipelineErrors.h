// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPipelineErrors_h
#define medialvoxelPipelineErrors_h

#include "Errors.h"
#include "Text.h"

#include "itkMacro.h"
#include "itkMedialVoxelMemoryShortage.h"

#include <new>

namespace medialvoxel
{

/** Calls the function and turns failures of the pipeline, for example a missing file, into JobError. */
template <typename TFunction>
auto
WithPipelineErrors(TFunction && function)
{
  try
  {
    return function();
  }
  catch (const itk::ExceptionObject & error)
  {
    throw JobError(ExitStatus::Failure, RemoveOrigin(error.GetDescription()));
  }
  catch (const itk::MedialVoxelMemoryShortage & error)
  {
    Fail(ExitStatus::Refused,
         "the walls are so thick that the windows on the input need at least ",
         FormatBytes(error.GetNeededBytes()),
         ", ",
         FormatBytes(error.GetAllowedBytes()),
         " of the memory are left for them; allow more with --memory");
  }
  catch (const std::bad_alloc &)
  {
    throw JobError(ExitStatus::Failure, "out of memory");
  }
}

} // end namespace medialvoxel

#endif
