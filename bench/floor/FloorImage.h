// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef FloorImage_h
#define FloorImage_h

#include "FloorSupport.h"

#include "itkImage.h"
#include "itkMultiThreaderBase.h"

#include <cstdlib>
#include <ctime>

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

/** Update a filter and print wall and processor seconds as one line of JSON. */
template <typename TFilter>
void
MeasureFilter(TFilter & filter)
{
  const auto         start = std::chrono::steady_clock::now();
  const std::clock_t clock = std::clock();
  filter.Update();
  const double cpu = static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC;
  std::cout << "{\"filter_seconds\": " << SecondsSince(start) << ", \"filter_cpu_seconds\": " << cpu
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
