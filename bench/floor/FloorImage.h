// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef FloorImage_h
#define FloorImage_h

#include "FloorSupport.h"

#include "itkImage.h"
#include "itkMultiThreaderBase.h"

#include <cstdlib>
#include <sys/resource.h>

using InputImageType = itk::Image<unsigned char, 3>;

/** A headerless volume of unsigned bytes as an image. */
inline InputImageType::Pointer
ReadVolume(const std::string & name, const std::array<std::int64_t, 3> & size)
{
  InputImageType::SizeType imageSize;
  for (unsigned int d = 0; d < 3; ++d)
  {
    imageSize[d] = static_cast<itk::SizeValueType>(size[d]);
  }
  const auto image = InputImageType::New();
  image->SetRegions(imageSize);
  image->Allocate();
  std::ifstream file(name, std::ios::binary);
  if (!file.read(reinterpret_cast<char *>(image->GetBufferPointer()), size[0] * size[1] * size[2]))
  {
    throw std::runtime_error("\"" + name + "\" cannot be read or is shorter than its size says");
  }
  return image;
}

/** Processor seconds of this process so far: in its own code, and in the system, which makes the pages of new memory.
 */
struct ProcessorSeconds
{
  ProcessorSeconds()
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    user = static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
    system = static_cast<double>(usage.ru_stime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_stime.tv_usec);
  }

  double user{ 0.0 };
  double system{ 0.0 };
};

/** Update a filter and print wall and processor seconds as one line of JSON. */
template <typename TFilter>
void
MeasureFilter(TFilter & filter)
{
  const auto             start = std::chrono::steady_clock::now();
  const ProcessorSeconds before;
  filter.Update();
  const ProcessorSeconds after;
  const double           user = after.user - before.user;
  const double           system = after.system - before.system;
  std::cout << "{\"filter_seconds\": " << SecondsSince(start) << ", \"filter_cpu_seconds\": " << user + system
            << ", \"filter_user_seconds\": " << user << ", \"filter_system_seconds\": " << system
            << ", \"peak_memory_bytes\": " << GetPeakMemory() << "}\n";
}

/** The program \a name INPUT.raw X,Y,Z [THREADS]: calls measure(image). */
template <typename TMeasure>
int
RunOnVolume(const std::string & name, const int argc, char * argv[], TMeasure && measure)
{
  try
  {
    if (argc != 3 && argc != 4)
    {
      throw std::invalid_argument("usage: " + name + " INPUT.raw X,Y,Z [THREADS]");
    }
    const std::array<std::int64_t, 3> size = ParseSize(argv[2]);
    if (argc == 4)
    {
      itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(static_cast<itk::ThreadIdType>(std::stoul(argv[3])));
    }
    measure(ReadVolume(argv[1], size));
    return EXIT_SUCCESS;
  }
  catch (const std::invalid_argument & error)
  {
    std::cerr << name << ": " << error.what() << '\n';
    return 2;
  }
  catch (const std::exception & error)
  {
    std::cerr << name << ": " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}

#endif
