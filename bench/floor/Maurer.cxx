// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-maurer: ITK's exact distance transform on the same input, to measure the distance phase against.
// Reads a headerless volume of unsigned bytes whole and computes squared distances to the object's border.

#include "FloorSupport.h"

#include "itkImage.h"
#include "itkMultiThreaderBase.h"
#include "itkSignedMaurerDistanceMapImageFilter.h"

#include <cstdlib>
#include <vector>

namespace
{
using InputImageType = itk::Image<unsigned char, 3>;
using DistanceImageType = itk::Image<float, 3>;
using FilterType = itk::SignedMaurerDistanceMapImageFilter<InputImageType, DistanceImageType>;

InputImageType::Pointer
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

void
Measure(const std::string & name, const std::array<std::int64_t, 3> & size)
{
  const auto start = std::chrono::steady_clock::now();
  const auto filter = FilterType::New();
  filter->SetInput(ReadVolume(name, size));
  filter->SquaredDistanceOn();
  filter->UseImageSpacingOff();
  const auto startOfFilter = std::chrono::steady_clock::now();
  filter->Update();
  std::cout << "{\"filter_seconds\": " << SecondsSince(startOfFilter) << ", \"seconds\": " << SecondsSince(start)
            << ", \"peak_memory_bytes\": " << GetPeakMemory() << "}\n";
}
} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    if (argc != 3 && argc != 4)
    {
      throw std::invalid_argument("usage: medialvoxel-maurer INPUT.raw X,Y,Z [THREADS]");
    }
    const std::array<std::int64_t, 3> size = ParseSize(argv[2]);
    if (argc == 4)
    {
      itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(static_cast<itk::ThreadIdType>(std::stoul(argv[3])));
    }
    Measure(argv[1], size);
    return EXIT_SUCCESS;
  }
  catch (const std::invalid_argument & error)
  {
    std::cerr << "medialvoxel-maurer: " << error.what() << '\n';
    return 2;
  }
  catch (const std::exception & error)
  {
    std::cerr << "medialvoxel-maurer: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
