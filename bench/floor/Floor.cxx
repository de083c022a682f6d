// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-floor: the least that any extraction must do, to measure extractions against.
// Reads a headerless volume of unsigned bytes slice by slice, thresholds it, writes a file with so many bytes per
// voxel.

#include "FloorSupport.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace
{
struct Arguments
{
  std::string                 input;
  std::string                 output;
  std::array<std::int64_t, 3> size;
  int                         threshold;
  bool                        flush{ false };
  std::size_t                 bytesPerVoxel{ 1 };
};

class Descriptor
{
public:
  Descriptor(const std::string & name, int flags)
    : m_Name(name)
    , m_Value(open(name.c_str(), flags, 0644))
  {
    Check(m_Value);
  }

  ~Descriptor() { close(m_Value); }
  Descriptor(const Descriptor &) = delete;
  Descriptor &
  operator=(const Descriptor &) = delete;

  void
  Read(std::vector<unsigned char> & bytes)
  {
    for (std::size_t done = 0; done < bytes.size();)
    {
      const std::size_t count = Check(read(m_Value, bytes.data() + done, bytes.size() - done));
      if (count == 0)
      {
        throw std::runtime_error("\"" + m_Name + "\" is shorter than its size says");
      }
      done += count;
    }
  }

  void
  Write(const std::vector<unsigned char> & bytes)
  {
    for (std::size_t done = 0; done < bytes.size();)
    {
      done += Check(write(m_Value, bytes.data() + done, bytes.size() - done));
    }
  }

  void
  Flush()
  {
    Check(fsync(m_Value));
  }

private:
  std::size_t
  Check(ssize_t result) const
  {
    if (result < 0)
    {
      throw std::system_error(errno, std::generic_category(), m_Name);
    }
    return static_cast<std::size_t>(result);
  }

  std::string m_Name;
  int         m_Value;
};

[[noreturn]] void
RefuseUsage()
{
  throw std::invalid_argument(
    "usage: medialvoxel-floor INPUT.raw X,Y,Z THRESHOLD OUTPUT.raw [--flush] [--bytes-per-voxel N]");
}

Arguments
ParseArguments(const std::vector<std::string> & words)
{
  if (words.size() < 4)
  {
    RefuseUsage();
  }
  Arguments arguments{ words[0], words[3], ParseSize(words[1]), std::stoi(words[2]) };
  for (std::size_t i = 4; i < words.size(); ++i)
  {
    if (words[i] == "--flush")
    {
      arguments.flush = true;
    }
    else if (words[i] == "--bytes-per-voxel" && i + 1 < words.size())
    {
      arguments.bytesPerVoxel = std::stoul(words[++i]);
    }
    else
    {
      RefuseUsage();
    }
  }
  return arguments;
}

/** \return the number of voxels at the threshold or above, which become 1; the others become 0. */
std::int64_t
Threshold(std::vector<unsigned char> & slice, int threshold)
{
  std::int64_t objectVoxels = 0;
  for (unsigned char & value : slice)
  {
    value = value >= threshold;
    objectVoxels += value;
  }
  return objectVoxels;
}

std::int64_t
CopyThresholded(const Arguments & arguments)
{
  Descriptor                 input(arguments.input, O_RDONLY);
  Descriptor                 output(arguments.output, O_WRONLY | O_CREAT | O_TRUNC);
  std::vector<unsigned char> slice(static_cast<std::size_t>(arguments.size[0] * arguments.size[1]));
  std::vector<unsigned char> wide(slice.size() * arguments.bytesPerVoxel);
  std::int64_t               objectVoxels = 0;
  for (std::int64_t z = 0; z < arguments.size[2]; ++z)
  {
    input.Read(slice);
    objectVoxels += Threshold(slice, arguments.threshold);
    for (std::size_t i = 0; i < slice.size(); ++i)
    {
      std::fill_n(wide.data() + i * arguments.bytesPerVoxel, arguments.bytesPerVoxel, slice[i]);
    }
    output.Write(wide);
  }
  if (arguments.flush)
  {
    output.Flush();
  }
  return objectVoxels;
}
} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    const Arguments    arguments = ParseArguments({ argv + 1, argv + argc });
    const auto         start = std::chrono::steady_clock::now();
    const std::int64_t objectVoxels = CopyThresholded(arguments);
    std::cout << "{\"object_voxels\": " << objectVoxels << ", \"seconds\": " << SecondsSince(start)
              << ", \"peak_memory_bytes\": " << GetPeakMemory() << "}\n";
    return EXIT_SUCCESS;
  }
  catch (const std::invalid_argument & error)
  {
    std::cerr << "medialvoxel-floor: " << error.what() << '\n';
    return 2;
  }
  catch (const std::exception & error)
  {
    std::cerr << "medialvoxel-floor: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
