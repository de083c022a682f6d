// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// medialvoxel-tiles: CPU seconds of every tile of an extraction, and of what one thread does between the tiles.
// Runs the engine on one thread over a headerless volume of bytes; prints JSON that bench/measure_tiles.py reads.

#include "FloorSupport.h"

#include "itkMedialVoxelClassifier.h"
#include "itkMedialVoxelSlabWalker.h"
#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelObjectPredicate.h"

#include <cstdlib>
#include <ctime>

namespace
{
/** Processor seconds of this thread. */
double
Now()
{
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<unsigned char>
ReadVolume(const std::string & name, const std::array<std::int64_t, 3> & size)
{
  std::vector<unsigned char> voxels(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  std::ifstream              file(name, std::ios::binary);
  if (!file.read(reinterpret_cast<char *>(voxels.data()), static_cast<std::streamsize>(voxels.size())))
  {
    throw std::runtime_error("\"" + name + "\" cannot be read or is shorter than its size says");
  }
  return voxels;
}

/** Processes tiles one by one, as the filter's workers do, and keeps their seconds. */
class TileClock : public itk::MedialVoxelTileRunner
{
public:
  /** The tiles between which threads do not wait for each other, and the work of one thread before them. */
  struct Layer
  {
    double              serialSeconds;
    std::vector<double> tileSeconds;
  };

  TileClock(const itk::MedialVoxelGrid &       grid,
            const itk::MedialVoxelParameters & parameters,
            const std::vector<unsigned char> & voxels,
            const itk::MedialVoxelSlabWalker & engine)
    : m_Grid(grid)
    , m_Transform(grid)
    , m_Classifier(grid, parameters)
    , m_Voxels(voxels)
    , m_Engine(engine)
    , m_End(Now())
  {}

  void
  FillObject(const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object, itk::MedialVoxelBits *) override
  {
    const auto   predicate = itk::MedialVoxelObjectPredicate<unsigned char>::DifferentFrom(0);
    const auto & size = m_Grid.GetSize();
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
      {
        itk::MedialVoxelPackRow(&m_Voxels[static_cast<std::size_t>((z * size[1] + y) * size[0] + box.lower[0])],
                                box.lower[0],
                                box.Extent(0),
                                predicate,
                                object.GetRow(y, z) - object.GetFirstWord());
      }
    }
  }

  void
  RunTiles(itk::MedialVoxelTileSchedule & schedule) override
  {
    double start = Now();
    Layer  layer{ start - m_End, {} };
    for (itk::MedialVoxelBox tile; schedule.Next(tile); start = m_End)
    {
      const itk::MedialVoxelBox missing = this->Process(tile);
      if (!missing.IsEmpty())
      {
        schedule.Defer(tile, missing);
      }
      m_End = Now();
      layer.tileSeconds.push_back(m_End - start);
    }
    m_Layers.push_back(std::move(layer));
  }

  const std::vector<Layer> &
  GetLayers() const
  {
    return m_Layers;
  }

private:
  itk::MedialVoxelBox
  Process(const itk::MedialVoxelBox & tile)
  {
    const itk::MedialVoxelWindow window = m_Engine.GetWindow().GetWindow(itk::MedialVoxelBoundary::Background);
    const itk::MedialVoxelBox    voxels = m_Classifier.GetVoxelBox(tile);
    if (!window.object->Any(voxels))
    {
      return {};
    }
    const itk::MedialVoxelBox missing =
      m_Transform.Compute(window, voxels, m_TransformWorkspace, m_Features, &m_Progress);
    return missing.IsEmpty()
             ? m_Classifier.Classify(window, tile, m_Features, m_Progress, m_Workspace, m_Labels, m_Counts)
             : missing;
  }

  const itk::MedialVoxelGrid &                m_Grid;
  itk::MedialVoxelFeatureTransform            m_Transform;
  itk::MedialVoxelClassifier                  m_Classifier;
  const std::vector<unsigned char> &          m_Voxels;
  const itk::MedialVoxelSlabWalker &          m_Engine;
  itk::MedialVoxelNoProgress                  m_Progress;
  itk::MedialVoxelFeatureTransform::Workspace m_TransformWorkspace;
  itk::MedialVoxelFeatures                    m_Features;
  itk::MedialVoxelClassifier::Workspace       m_Workspace;
  std::vector<std::uint8_t>                   m_Labels;
  itk::MedialVoxelCounts                      m_Counts;
  std::vector<Layer>                          m_Layers;
  double                                      m_End;
};

void
PrintLayers(const std::vector<TileClock::Layer> & layers)
{
  std::cout << "{\"layers\": [";
  const char * separator = "";
  for (const TileClock::Layer & layer : layers)
  {
    std::cout << separator << "{\"serial_seconds\": " << layer.serialSeconds << ", \"tile_seconds\": [";
    const char * comma = "";
    for (const double seconds : layer.tileSeconds)
    {
      std::cout << comma << seconds;
      comma = ", ";
    }
    std::cout << "]}";
    separator = ",\n";
  }
  std::cout << "]}\n";
}

void
Measure(const std::string & name, const std::array<std::int64_t, 3> & size, const double thickness)
{
  const std::vector<unsigned char> voxels = ReadVolume(name, size);
  const itk::MedialVoxelGrid       grid(size, { { 1.0, 1.0, 1.0 } });
  itk::MedialVoxelParameters       parameters;
  parameters.epsilon = itk::MedialVoxelParameters::EpsilonFromThickness(thickness);
  itk::MedialVoxelSlabWalker engine(grid,
                                    itk::MedialVoxelSlabWalker::Settings::ForClassification(grid, parameters, false));
  TileClock                  clock(grid, parameters, voxels, engine);
  engine.Run(grid.GetVoxelBox(), clock);
  PrintLayers(clock.GetLayers());
}
} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    if (argc != 3 && argc != 4)
    {
      throw std::invalid_argument("usage: medialvoxel-tiles INPUT.raw X,Y,Z [THICKNESS]");
    }
    Measure(argv[1], ParseSize(argv[2]), argc == 4 ? std::stod(argv[3]) : 3.0);
    return EXIT_SUCCESS;
  }
  catch (const std::invalid_argument & error)
  {
    std::cerr << "medialvoxel-tiles: " << error.what() << '\n';
    return 2;
  }
  catch (const std::exception & error)
  {
    std::cerr << "medialvoxel-tiles: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
