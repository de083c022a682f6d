// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ProductRows.h"

#include "HtmlReport.h"
#include "PlaceSurvey.h"
#include "PlaceTable.h"
#include "Preview.h"
#include "SheetSurvey.h"
#include "SurveySummary.h"
#include "ThicknessPreview.h"

#include <utility>

namespace medialvoxel
{
namespace
{

/** \class SurveyProduct
 * \brief Has a survey of the tiles, which others can save. */
template <typename TSurvey>
class SurveyProduct : public Product
{
public:
  itk::MedialVoxelTileObserver *
  GetObserver() override
  {
    return m_Survey.get();
  }

  bool
  IsSaved() const override
  {
    return m_Survey != nullptr;
  }

  void
  Clear() override
  {
    if (m_Survey)
    {
      m_Survey->Clear();
    }
  }

  std::string
  Save() const override
  {
    return m_Survey->Save();
  }

  void
  Merge(const std::string & bytes) override
  {
    m_Survey->Merge(bytes);
  }

protected:
  std::unique_ptr<TSurvey> m_Survey; ///< null before the start
};

/** \class StatisticsProduct
 * \brief Statistics of the thickness, and their histogram. */
class StatisticsProduct : public SurveyProduct<Survey>
{
public:
  explicit StatisticsProduct(const ExtractOptions & options)
    : m_Options(options)
  {
    m_Settings.picture = !options.previewFile.empty() || !options.htmlFile.empty();
  }

  static bool
  IsWanted(const ExtractOptions &)
  {
    return true;
  }

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    const std::uint64_t bytes = Survey::GetBytes(header.geometry, m_Settings);
    footprint.beside += bytes;
    footprint.saving += bytes;
    footprint.AddObserver(Survey::WorkerBytesPerVoxel);
  }

  void
  Start(ProductStart & start) override
  {
    const VolumeHeader & header = start.job.input;
    m_Survey = std::make_unique<Survey>(header.geometry, GetGrid(m_Options, header), m_Settings);
    start.survey = m_Survey.get();
  }

  void
  Describe(JobResult & result) override
  {
    result.thickness = Summarize(*m_Survey);
  }

private:
  std::string
  GetFileName() const override
  {
    return m_Options.thicknessCsvFile;
  }

  std::optional<std::string>
  MakeText(const JobResult &) const override
  {
    return MakeThicknessCsv(*m_Survey);
  }

  const ExtractOptions & m_Options;
  SurveySettings         m_Settings;
};

/** \class PlaceProduct
 * \brief Places with too thin or too thick walls, and their list. */
class PlaceProduct : public SurveyProduct<PlaceSurvey>
{
public:
  explicit PlaceProduct(const ExtractOptions & options)
    : m_Options(options)
  {
    for (const auto & [kind, limits] :
         { std::pair(PlaceKind::Thin, options.thinBelow), std::pair(PlaceKind::Thick, options.thickAbove) })
    {
      if (limits)
      {
        m_Settings.limits[kind] = *limits;
      }
    }
    m_Settings.smallestArea = options.smallestPlace;
  }

  static bool
  IsWanted(const ExtractOptions & options)
  {
    return ListsPlaces(options);
  }

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    const std::uint64_t bytes = PlaceSurvey::GetBytes(header.geometry, m_Settings);
    footprint.beside += bytes;
    footprint.saving += bytes;
    footprint.AddObserver(PlaceSurvey::WorkerBytesPerVoxel);
    footprint.surplus.most += PlaceSurvey::MostBytesPerVoxel;
    footprint.surplus.planned += PlaceSurvey::PlannedBytesPerVoxel;
    footprint.surplus.mostOfSlice += PlaceSurvey::MostBytesPerVoxelOfSlice;
    // A slice in one wall has many cells at once: half of what is left beside the walls themselves.
    footprint.surplus.shareOfRest = 2;
    ++footprint.surplus.takers;
  }

  void
  Start(ProductStart & start) override
  {
    const VolumeHeader & header = start.job.input;
    m_Survey = std::make_unique<PlaceSurvey>(header.geometry,
                                             GetGrid(m_Options, header),
                                             m_Settings,
                                             start.survey->GetAreaUnit(),
                                             start.job.plan.GetSurplusShare());
  }

  void
  BeginRegion(const itk::MedialVoxelBox & region) override
  {
    m_Survey->BeginRegion(region);
  }

  void
  Describe(JobResult & result) override
  {
    result.places = m_Survey->Summarize();
  }

private:
  std::string
  GetFileName() const override
  {
    return m_Options.placesFile;
  }

  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    return MakePlacesCsv(result.places);
  }

  const ExtractOptions & m_Options;
  PlaceSettings          m_Settings;
};

/** \class PictureProduct
 * \brief Pictures of labels and thickness, and the preview of both. */
class PictureProduct : public Product
{
public:
  explicit PictureProduct(const ExtractOptions & options)
    : m_Options(options)
  {}

  static bool
  IsWanted(const ExtractOptions & options)
  {
    return !options.previewFile.empty() || !options.htmlFile.empty();
  }

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    footprint.beside += GetPreviewBytes(header.geometry);
    footprint.beside += m_Options.thicknessFile.empty() ? 0 : GetThicknessPreviewBytes(header.geometry);
  }

  void
  Start(ProductStart & start) override
  {
    m_Survey = start.survey;
    start.pictures = &m_Pictures;
  }

  void
  Complete(JobResult & result, const ProductEnd & end) override
  {
    const VolumeGeometry & geometry = result.input.geometry;
    const VoxelOutput &    labels = *end.outputs.FindVolume("labels");
    const Canvas           canvas = DrawPreview(labels, geometry, *m_Survey);
    m_Pictures.labels = canvas.EncodePng();
    m_Preview = m_Pictures.labels;
    if (const VoxelOutput * const thicknesses = end.outputs.FindVolume("thickness_map"))
    {
      const char * const unit = m_Options.voxelUnits ? "voxels" : geometry.inMillimeters ? "mm" : "units";
      const Canvas       other = DrawThicknessPreview(labels, *thicknesses, geometry, *m_Survey, unit);
      m_Pictures.thicknesses = other.EncodePng();
      m_Preview = JoinCanvases(canvas, other).EncodePng();
    }
  }

private:
  std::string
  GetFileName() const override
  {
    return m_Options.previewFile;
  }

  std::optional<std::string>
  MakeText(const JobResult &) const override
  {
    return m_Preview;
  }

  const ExtractOptions & m_Options;
  const Survey *         m_Survey{ nullptr };
  Pictures               m_Pictures;
  std::string            m_Preview;
};

/** \class PageProduct
 * \brief The page, with points of the sheet where the program has a viewer for them. */
class PageProduct : public SurveyProduct<SheetSurvey>
{
public:
  explicit PageProduct(const ExtractOptions & options)
    : m_Options(options)
  {}

  static bool
  IsWanted(const ExtractOptions & options)
  {
    return !options.htmlFile.empty();
  }

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    const PreviewLayout layout = ArrangePreview(header.geometry);
    const unsigned int  pictures = m_Options.thicknessFile.empty() ? 1 : 2;
    footprint.beside += pictures * PerPixel * layout.width * layout.height + GetPageViewBytes(header.geometry);
    if (HasPageViewer())
    {
      footprint.AddObserver(SheetSurvey::WorkerBytesPerVoxel);
      footprint.beside += SheetSurvey::GetBytes(header.geometry);
      footprint.saving += SheetSurvey::GetSavedBytes(header.geometry);
    }
  }

  void
  Start(ProductStart & start) override
  {
    m_Thickness = start.survey;
    m_Pictures = start.pictures;
    if (HasPageViewer())
    {
      const double unit = m_Thickness->GetSums().GetAreas().GetBinWidth();
      m_Survey = std::make_unique<SheetSurvey>(start.job.input.geometry, unit, m_Thickness->GetSample());
    }
  }

private:
  /** Bytes of pictures of few colors, which pack to less than half of one, as text, also while the page grows. */
  static constexpr std::uint64_t PerPixel = 3;

  std::string
  GetFileName() const override
  {
    return m_Options.htmlFile;
  }

  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    const ColorRange colors = GetColorRange(m_Thickness->GetSums().GetAreas());
    return MakeHtmlReport(m_Options, result, *m_Pictures, { m_Survey.get(), colors });
  }

  const ExtractOptions & m_Options;
  const Survey *         m_Thickness{ nullptr };
  const Pictures *       m_Pictures{ nullptr };
};

} // namespace

const ProductRow StatisticsRow = MakeRow<StatisticsProduct>();
const ProductRow PictureRow = MakeRow<PictureProduct>();
const ProductRow PlaceRow = MakeRow<PlaceProduct>();
const ProductRow PageRow = MakeRow<PageProduct>();

} // end namespace medialvoxel
