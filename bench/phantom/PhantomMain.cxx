// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-phantom: writes a synthetic part as a volume file, slab by slab. The help text below is the manual.

#include "PhantomRasterizer.h"
#include "PhantomWriter.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace
{
struct Arguments
{
  std::string               kind;
  phantom::ShapeParameters  shape;
  phantom::Noise            noise;
  phantom::OutputParameters output;
  std::string               typeName{ "uint8" };
  std::int64_t              slab{ 16 };
  unsigned int              threads{ std::max(1U, std::thread::hardware_concurrency()) };
};

void
PrintHelp()
{
  std::cout << "Usage: medialvoxel-phantom KIND OUTPUT [options]\n\n"
               "Writes a synthetic part as an uncompressed volume; prints one line of JSON on success.\n"
               "The same options give the same bytes, whatever the slab and the threads.\n\n"
               "KIND    one of:";
  for (const std::string & kind : phantom::GetKinds())
  {
    std::cout << ' ' << kind;
  }
  std::cout << "\nOUTPUT  file, .raw (no header), .mha or .nrrd\n\n"
               "  --size X,Y,Z      voxels; default 708,965,325 (side-frame), 1500,1500,668 (cover),\n"
               "                    512,512,512 (solids), 256,256,256 (others)\n"
               "  --spacing X,Y,Z   written to the header; default 1,1,1\n"
               "  --wall T          plate, shell, t-junction: wall in voxels; default 4\n"
               "  --normal A,B,C    plate: direction across the plate; default 0,0,1\n"
               "  --noise R         shift the surface by up to R voxels, at every voxel; default 0\n"
               "  --seed N          of the noise; default 1\n"
               "  --type T          uint8 (default), uint16 or float32\n"
               "  --values B,O      values of background and object; default 0,255\n"
               "  --slab N          slices in memory; default 16\n"
               "  --threads N       default: the number of cores\n";
}

template <typename TNumber>
TNumber
ParseNumber(const std::string & option, const std::string & text, double low, double high)
{
  std::istringstream stream(text);
  TNumber            value{};
  if (!(stream >> value) || !stream.eof() ||
      !(value >= static_cast<TNumber>(low) && value <= static_cast<TNumber>(high)))
  {
    std::ostringstream message;
    message << option << " " << text << ": expected a number from " << low << " to " << high;
    throw std::invalid_argument(message.str());
  }
  return value;
}

template <typename TNumber>
std::vector<TNumber>
ParseList(const std::string & option, const std::string & text, std::size_t count, double low, double high)
{
  std::vector<TNumber> values;
  std::istringstream   stream(text);
  for (std::string item; std::getline(stream, item, ',');)
  {
    values.push_back(ParseNumber<TNumber>(option, item, low, high));
  }
  if (values.size() != count)
  {
    throw std::invalid_argument(option + " " + text + ": expected " + std::to_string(count) +
                                " numbers with commas between them");
  }
  return values;
}

phantom::Vector
ParseVector(const std::string & option, const std::string & text, double low, double high)
{
  const std::vector<double> v = ParseList<double>(option, text, 3, low, high);
  return { v[0], v[1], v[2] };
}

phantom::PixelType
ParseType(const std::string & text)
{
  if (text == "uint8")
  {
    return phantom::PixelType::UInt8;
  }
  if (text == "uint16")
  {
    return phantom::PixelType::UInt16;
  }
  if (text == "float32")
  {
    return phantom::PixelType::Float32;
  }
  throw std::invalid_argument("--type " + text + ": expected uint8, uint16 or float32");
}

void
ParseOption(const std::string & option, const std::string & text, Arguments & arguments)
{
  if (option == "--size")
  {
    const std::vector<std::int64_t> v = ParseList<std::int64_t>(option, text, 3, 1, 100000);
    arguments.shape.size = { v[0], v[1], v[2] };
  }
  else if (option == "--spacing")
  {
    arguments.output.spacing = ParseVector(option, text, 1e-9, 1e9);
  }
  else if (option == "--wall")
  {
    arguments.shape.wall = ParseNumber<double>(option, text, 1e-3, 1e5);
  }
  else if (option == "--normal")
  {
    arguments.shape.normal = ParseVector(option, text, -1e6, 1e6);
  }
  else if (option == "--noise")
  {
    arguments.noise.amplitude = ParseNumber<double>(option, text, 0, 1e3);
  }
  else if (option == "--seed")
  {
    arguments.noise.seed = static_cast<std::uint64_t>(ParseNumber<std::int64_t>(option, text, 0, 1e18));
  }
  else if (option == "--type")
  {
    arguments.typeName = text;
    arguments.output.type = ParseType(text);
  }
  else if (option == "--values")
  {
    const std::vector<double> v = ParseList<double>(option, text, 2, -3e38, 3e38);
    arguments.output.background = v[0];
    arguments.output.object = v[1];
  }
  else if (option == "--slab")
  {
    arguments.slab = ParseNumber<std::int64_t>(option, text, 1, 100000);
  }
  else if (option == "--threads")
  {
    arguments.threads = ParseNumber<unsigned int>(option, text, 1, 1024);
  }
  else
  {
    throw std::invalid_argument("unknown option " + option);
  }
}

Arguments
ParseArguments(const std::vector<std::string> & words)
{
  Arguments                arguments;
  std::vector<std::string> positional;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    if (words[i].rfind("--", 0) != 0)
    {
      positional.push_back(words[i]);
      continue;
    }
    if (i + 1 == words.size())
    {
      throw std::invalid_argument(words[i] + ": a value is missing");
    }
    ParseOption(words[i], words[i + 1], arguments);
    ++i;
  }
  if (positional.size() != 2)
  {
    throw std::invalid_argument("expected KIND and OUTPUT; --help shows the options");
  }
  arguments.kind = positional[0];
  arguments.output.fileName = positional[1];
  if (arguments.shape.size == phantom::Size{ 0, 0, 0 })
  {
    arguments.shape.size = phantom::GetDefaultSize(arguments.kind);
  }
  return arguments;
}

std::int64_t
WriteVolume(const Arguments & arguments)
{
  const phantom::Size &                 size = arguments.shape.size;
  const std::unique_ptr<phantom::Shape> shape = phantom::MakeShape(arguments.kind, arguments.shape);
  phantom::VolumeWriter                 writer(arguments.output, size);
  std::vector<unsigned char>            mask;
  std::int64_t                          objectVoxels = 0;
  for (std::int64_t z = 0; z < size[2]; z += arguments.slab)
  {
    const std::int64_t slices = std::min(arguments.slab, size[2] - z);
    objectVoxels += phantom::RasterizeSlab(*shape, arguments.noise, size, z, slices, arguments.threads, mask);
    writer.Append(mask);
  }
  writer.Close();
  return objectVoxels;
}

void
PrintSummary(const Arguments & arguments, std::int64_t objectVoxels, double seconds)
{
  const phantom::Size & size = arguments.shape.size;
  const double          voxels = static_cast<double>(size[0]) * size[1] * size[2];
  std::cout << "{\"kind\": \"" << arguments.kind << "\", \"size\": [" << size[0] << ", " << size[1] << ", " << size[2]
            << "], \"type\": \"" << arguments.typeName << "\", \"noise\": " << arguments.noise.amplitude
            << ", \"seed\": " << arguments.noise.seed << ", \"object_voxels\": " << objectVoxels
            << ", \"object_percent\": " << 100.0 * static_cast<double>(objectVoxels) / voxels
            << ", \"seconds\": " << seconds << "}\n";
}
} // namespace

int
main(int argc, char * argv[])
{
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (std::find(words.begin(), words.end(), "--help") != words.end())
  {
    PrintHelp();
    return EXIT_SUCCESS;
  }
  try
  {
    const auto         start = std::chrono::steady_clock::now();
    const Arguments    arguments = ParseArguments(words);
    const std::int64_t objectVoxels = WriteVolume(arguments);
    PrintSummary(
      arguments, objectVoxels, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return EXIT_SUCCESS;
  }
  catch (const std::invalid_argument & error)
  {
    std::cerr << "medialvoxel-phantom: " << error.what() << '\n';
    return 2;
  }
  catch (const std::exception & error)
  {
    std::cerr << "medialvoxel-phantom: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
