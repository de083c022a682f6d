// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include "AbortNotice.h"
#include "Errors.h"
#include "Signals.h"
#include "StopListener.h"
#include "Terminal.h"

#include "itkMedialVoxelHeaderText.h"
#include "itkObject.h"

#include <exception>
#include <iostream>

namespace medialvoxel
{

int
RunProgram(const std::string & name, const std::function<int()> & body)
{
  const auto report = [&name](const std::exception & error, int status) {
    std::cerr << name << ": " << itk::MedialVoxelText::MakePrintable(error.what()) << std::endl;
    return status;
  };
  PrepareStreams();
  CatchSignals();
  SetNameForAborts(name);
  // The job prints one line for each warning; a filter would print three.
  itk::Object::GlobalWarningDisplayOff();
  try
  {
    const StopListener listener;
    const int          status = body();
    if (!std::cout.flush())
    {
      throw JobError(ExitStatus::Failure, "cannot write to the standard output");
    }
    return status;
  }
  catch (const JobError & error)
  {
    return report(error, static_cast<int>(error.GetStatus()));
  }
  catch (const StoppedBySignal & stop)
  {
    return report(stop, 128 + stop.GetSignalNumber());
  }
  catch (const std::exception & error)
  {
    return report(error, static_cast<int>(ExitStatus::Failure));
  }
}

} // end namespace medialvoxel
