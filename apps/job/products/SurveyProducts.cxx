// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HtmlReport.h"
#include "Outputs.h"
#include "PlaceSurvey.h"
#include "PlaceJson.h"
#include "PlaceSections.h"
#include "Preview.h"
#include "Products.h"
#include "SheetSurvey.h"
#include "SurveySummary.h"
#include "ThicknessPreview.h"

namespace medialvoxel
{
namespace
{

bool
WantsPictures(const ExtractOptions & options)
{
  return !options.previewFile.empty() || !options.htmlFile.empty();
}

/** \class SurveyProduct
 * \brief Has a survey of the tiles. */
template <typename TSurvey>
class SurveyProduct : public ExtractProduct
{
public:
  using ExtractProduct::ExtractProduct;

protected:
  template <typename... TArguments>
  void
  StartSurvey(TArguments &&... arguments)
  {
    m_Survey = std::make_unique<TSurvey>(std::forward<TArguments>(arguments)...);
    m_Links.observer = m_Links.survey = m_Survey.get();
  }

  std::unique_ptr<TSurvey> m_Survey; ///< null before the start
};

/** \class StatisticsProduct
 * \brief Statistics of the thickness. */
class StatisticsProduct : public SurveyProduct<Survey>
{
public:
  using SurveyProduct::SurveyProduct;

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    footprint.Add(Survey::GetFootprint(header.geometry, this->GetSettings()));
  }

  void
  Start(ProductStart & start) override
  {
    const VolumeHeader & header = start.job.input;
    this->StartSurvey(header.geometry, GetGrid(header), this->GetSettings());
    start.survey = m_Survey.get();
  }

  void
  Describe(JobResult & result) override
  {
    result.thickness = MakeThickness(m_Survey->GetSums(), *m_Survey);
    const auto thinnest = m_Survey->FindThinnest();
    const bool isWhole = m_Survey->GetSample().GetStep() == 1;
    result.thickness["thinnest"] =
      thinnest && isWhole ? LocationToJson(*thinnest, m_Survey->GetDimension()) : Json(nullptr);
    result.uncertainty = MakeUncertainty(m_Survey->GetSums());
  }

private:
  SurveySettings
  GetSettings() const
  {
    SurveySettings settings;
    settings.picture = WantsPictures(m_Options);
    return settings;
  }
};

/** \class PlaceProduct
 * \brief Places with too thin or too thick walls, and their list. */
class PlaceProduct : public SurveyProduct<PlaceSurvey>
{
public:
  using SurveyProduct::SurveyProduct;

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    footprint.Add(PlaceSurvey::GetFootprint(header.geometry, this->GetSettings()));
  }

  void
  Start(ProductStart & start) override
  {
    const VolumeHeader & header = start.job.input;
    this->StartSurvey(header.geometry,
                      GetGrid(header),
                      this->GetSettings(),
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
  PlaceSettings
  GetSettings() const
  {
    PlaceSettings settings;
    for (const auto & [kind, limits] :
         { std::pair(PlaceKind::Thin, m_Options.thinBelow), std::pair(PlaceKind::Thick, m_Options.thickAbove) })
    {
      if (limits)
      {
        settings[kind] = *limits;
      }
    }
    return settings;
  }

  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    return MakePlacesCsv(result.places);
  }
};

/** \class PictureProduct
 * \brief Pictures of labels and thickness, and the preview of both. */
class PictureProduct : public ExtractProduct
{
public:
  using ExtractProduct::ExtractProduct;

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    footprint.beside += GetPreviewMemory(header.geometry);
    footprint.beside += m_Options.thicknessFile.empty() ? 0 : GetThicknessPreviewMemory(header.geometry);
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
      const ColorRange colors = m_Options.colorRange.value_or(GetColorRange(m_Survey->GetSums().GetAreas()));
      const Canvas     other = DrawThicknessPreview(labels, *thicknesses, geometry, *m_Survey, colors);
      m_Pictures.thicknesses = other.EncodePng();
      m_Preview = JoinCanvases(canvas, other).EncodePng();
    }
  }

private:
  std::optional<std::string>
  MakeText(const JobResult &) const override
  {
    return m_Preview;
  }

  const Survey * m_Survey{ nullptr };
  Pictures       m_Pictures;
  std::string    m_Preview;
};

/** \class PageProduct
 * \brief The page, with points of the sheet where the program has a viewer for them. */
class PageProduct : public SurveyProduct<SheetSurvey>
{
public:
  using SurveyProduct::SurveyProduct;

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    // Bytes of pictures of few colors, which pack to less than half of one, as text, also while the page grows.
    constexpr std::uint64_t perPixel = 3;
    const PreviewLayout     layout = ArrangePreview(header.geometry);
    const unsigned int      pictures = m_Options.thicknessFile.empty() ? 1 : 2;
    const bool              hasImportance = FindsImportance(m_Options);
    const unsigned int      numbers = (hasImportance ? 1 : 0) + (NumbersWalls(m_Options) ? 1 : 0);
    footprint.beside += pictures * perPixel * layout.width * layout.height;
    footprint.beside += GetPageViewMemory(header.geometry, numbers);
    footprint.beside += ListsPlaces(m_Options) ? GetSectionMemory() : 0;
    if (HasPageViewer())
    {
      footprint.Add(SheetSurvey::GetFootprint(header.geometry, hasImportance));
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
      this->StartSurvey(start.job.input.geometry, unit, m_Thickness->GetSample());
      start.sheet = m_Survey.get();
    }
  }

private:
  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    const ColorRange colors = m_Options.colorRange.value_or(GetColorRange(m_Thickness->GetSums().GetAreas()));
    Pictures         pictures = *m_Pictures;
    if (ListsPlaces(m_Options))
    {
      pictures.sections = DrawPlaceSections(result.places, result.input);
    }
    return MakeHtmlReport(result.report,
                          m_Options.command,
                          pictures,
                          { m_Survey.get(), colors, result.wallOfPoint },
                          result.input.geometry);
  }

  const Survey *   m_Thickness{ nullptr };
  const Pictures * m_Pictures{ nullptr };
};

} // namespace

const ProductRow StatisticsRow{ nullptr, Make<StatisticsProduct>, [](const ExtractOptions &) { return true; } };
const ProductRow PlaceRow{ &ExtractOptions::placesFile, Make<PlaceProduct>, ListsPlaces };
const ProductRow PictureRow{ &ExtractOptions::previewFile, Make<PictureProduct>, WantsPictures };
const ProductRow PageRow{ &ExtractOptions::htmlFile, Make<PageProduct> };

} // end namespace medialvoxel
