// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Writes what the filters compute to plain files, for checks outside C++.

#include "MedialVoxelTestRuns.h"

#include <fstream>
#include <iostream>

namespace
{
using namespace MedialVoxelTest;

template <typename TValue>
void
WriteFile(const std::string & path, const std::vector<TValue> & values)
{
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char *>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(TValue)));
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + path);
  }
}

/** Labels of both bounds, one byte per cell, x fastest. */
void
DumpLabels(const Volume & volume, const std::string & path)
{
  std::vector<unsigned char> labels;
  for (const Bound bound : { Bound::FreeSpace, Bound::Paper, Bound::Off })
  {
    const auto run = volume.size[2] == 1 ? RunMedialFilter<2>(volume, 3.0, bound).labels
                                         : RunMedialFilter<3>(volume, 3.0, bound).labels;
    labels.insert(labels.end(), run.begin(), run.end());
  }
  WriteFile(path, labels);
}

/** Mask (bytes) and norm of the vectors to the background border (doubles), with a header in JSON. */
void
DumpNorms(const Volume & volume, const std::string & prefix)
{
  auto filter = VectorFilter<3>::New();
  filter->SetInput(MakeImage<MaskImage<3>>(volume));
  filter->SetBoundary(itk::MedialVoxelBoundary::Background);
  filter->Update();
  std::vector<double> norms;
  for (const auto & vector : PixelsOf(filter->GetOutput()))
  {
    norms.push_back(NormOf(vector));
  }
  WriteFile(prefix + ".mask", volume.object);
  WriteFile(prefix + ".norm", norms);
  std::ofstream header(prefix + ".json");
  header.precision(17);
  header << "{ \"size\": [" << volume.size[0] << ", " << volume.size[1] << ", " << volume.size[2] << "], \"spacing\": ["
         << volume.spacing[0] << ", " << volume.spacing[1] << ", " << volume.spacing[2] << "] }\n";
  if (!header.flush())
  {
    throw std::runtime_error("cannot write " + prefix + ".json");
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try
  {
    if (arguments.size() == 3 && arguments[0] == "labels")
    {
      DumpLabels(Fixture(arguments[1]), arguments[2]);
    }
    else if (arguments.size() == 3 && arguments[0] == "norms")
    {
      DumpNorms(Fixture(arguments[1]), arguments[2]);
    }
    else if (arguments.size() == 4 && arguments[0] == "norms")
    {
      const auto image = ReadImage<itk::Image<short, 3>>(arguments[1]);
      DumpNorms(VolumeOf(image.GetPointer(), std::stod(arguments[3])), arguments[2]);
    }
    else
    {
      std::cerr << "usage: MedialVoxelTestDump labels FIXTURE FILE | norms FIXTURE PREFIX | norms IMAGE PREFIX "
                   "LOWER-THRESHOLD\n";
      return 2;
    }
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
