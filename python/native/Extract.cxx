// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayEngine.h"
#include "Errors.h"
#include "NamedCounts.h"
#include "TopologyJson.h"

#include "itkMedialVoxelObjectUnion.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \throw JobError when fits are asked for and there is no threshold for them */
void
CheckFits(const ArrayCall & call, const ExtractOptions & options)
{
  const bool isUncertain = call.outputs.uncertainty != nullptr;
  if ((isUncertain || options.materials) && !HasOneThreshold(options, call.header))
  {
    Fail(ExitStatus::Usage,
         isUncertain ? "the uncertainty of the thickness needs" : "levels of gray values need",
         " one threshold, lower or upper, that values of the array reach");
  }
}

itk::MedialVoxelSheetExtraction
MakeExtraction(const ArrayEngine & engine, const ArrayCall & call, const ExtractOptions & options)
{
  itk::MedialVoxelSheetExtraction extraction;
  extraction.parameters = GetParameters(options, engine.GetGrid());
  extraction.measuresThickness = call.outputs.thickness != nullptr || call.outputs.uncertainty != nullptr;
  extraction.findsLevels = options.sameTopology;
  extraction.findsImportance = call.outputs.importance != nullptr;
  if (call.outputs.vectors != nullptr)
  {
    extraction.vectorBoundary = options.vectorBoundary;
  }
  return extraction;
}

/** What one object and many have. */
nlohmann::json
Describe(const itk::MedialVoxelCounts &                   counts,
         const std::optional<itk::MedialVoxelRoughness> & roughness,
         const bool                                       isSmoothed,
         const ArrayMeasure &                             measure,
         const itk::MedialVoxelParameters &               parameters)
{
  const bool     isAutomatic = parameters.mode == itk::MedialVoxelThicknessMode::Automatic;
  nlohmann::json json;
  for (const NamedCount & count : NamedCounts)
  {
    json[count.name] = counts.*count.member;
  }
  json["medial_cells"] = counts.boundCells + counts.geodesicMedialCells;
  return { { "counts", json },
           { "smoothed", isSmoothed },
           { "roughness", roughness ? roughness->GetRatio() : 0.0 },
           { "max_thickness", isAutomatic ? nlohmann::json(2.0 * parameters.largestRadius) : nullptr },
           { "measure", measure.Describe() } };
}

nlohmann::json
ExtractOne(const ArrayCall & call, ExtractOptions options)
{
  const MedialVoxelOutputs &  outputs = call.outputs;
  ArrayEngine                 engine(call, options);
  itk::MedialVoxelObjectInput object = engine.MakeObject(GetSmoothing(options));
  engine.Prepare(object, options);
  itk::MedialVoxelSheetExtraction extraction = MakeExtraction(engine, call, options);
  const bool                      measures = extraction.measuresThickness;
  const ArrayMeasure              measure =
    engine.FindMeasure(object,
                       measures && MayMeasureOnGrayValues(options, call.header),
                       measures ? DescribeMeasureOnObject(options, call.header) : "no thickness is asked for",
                       options.materials);
  if (outputs.uncertainty != nullptr && !measure.found.scan)
  {
    Fail(ExitStatus::Refused, "array: the uncertainty of the thickness cannot be stated, as ", measure.found.reason);
  }
  extraction.grayRange = measure.range;
  const auto &                                strides = engine.GetStrides();
  std::optional<itk::MedialVoxelSameTopology> topology;
  if (options.sameTopology)
  {
    topology.emplace(engine.GetGrid(), extraction.parameters.maximumPoreSize, [&](const itk::MedialVoxelBits & added) {
      itk::MedialVoxelSameTopology::Label(added, engine.PlaceOf(outputs.labels, added.GetBox()), strides);
    });
  }
  const auto     sums = engine.Run(object, extraction, [&](const itk::MedialVoxelTileResult & tile) {
    tile.WriteLabels(engine.PlaceOf(outputs.labels, tile.box), strides);
    if (topology)
    {
      topology->TakeTile(tile);
    }
    if (outputs.thickness != nullptr)
    {
      tile.WriteThickness(engine.PlaceOf(outputs.thickness, tile.box), strides);
    }
    if (outputs.uncertainty != nullptr)
    {
      tile.WriteUncertainty(engine.PlaceOf(outputs.uncertainty, tile.box), strides);
    }
    if (outputs.importance != nullptr)
    {
      tile.WriteImportance(engine.PlaceOf(outputs.importance, tile.box), strides);
    }
    if (outputs.vectors != nullptr)
    {
      engine.WriteVectors(tile, outputs.vectors);
    }
  });
  nlohmann::json numbers =
    Describe(sums.counts, object.GetRoughness(), object.IsSmoothed(), measure, extraction.parameters);
  numbers["topology"] = topology ? DescribeTopology(topology->GetSums()) : Json(nullptr);
  return numbers;
}

/** \throw JobError Usage for a label that is a name, or that no value has; CorruptInput where values are no labels */
void
Prepare(ArrayEngine & engine, const ExtractOptions & options, itk::MedialVoxelLabelInput & map)
{
  if (!options.labels->names.empty())
  {
    Fail(ExitStatus::Usage,
         "array: the label '",
         options.labels->names.front(),
         "' is a name, which an array has none of");
  }
  try
  {
    engine.ReadBeforeRun([&](const auto & observer) { map.Prepare(observer); });
  }
  catch (const itk::MedialVoxelLabelError & error)
  {
    Fail(ExitStatus::CorruptInput, "array: ", error.what());
  }
  if (!map.GetMissingLabels().empty())
  {
    Fail(ExitStatus::Usage, "array: no value is the label ", map.GetMissingLabels().front());
  }
}

/** The outputs of thickness, which the union fills. */
std::vector<itk::MedialVoxelObjectUnion::Values>
MakeValues(const ArrayCall & call)
{
  float * const thickness = call.outputs.thickness;
  if (thickness == nullptr)
  {
    return {};
  }
  std::fill_n(thickness, call.header.geometry.GetNumberOfVoxels(), 0.0f);
  const auto write = [](const auto & tile, void * const first, const auto & strides) {
    tile.WriteThickness(static_cast<float *>(first), strides);
  };
  return { { reinterpret_cast<std::byte *>(thickness), sizeof(float), write } };
}

/** Writes the labels of cells and objects. */
void
Write(const itk::MedialVoxelObjectUnion & united, const itk::MedialVoxelLabelTable & table, const ArrayCall & call)
{
  std::copy(united.GetLabels().begin(), united.GetLabels().end(), call.outputs.labels);
  DispatchPixelType(call.header.pixelType, [&](auto zero) {
    using Value = decltype(zero);
    const auto valueOf = [&table](const itk::MedialVoxelObjectNumber object) {
      return object > 0 ? static_cast<Value>(table.GetValue(object)) : Value{};
    };
    auto * const objects = static_cast<Value *>(call.outputs.objects);
    std::transform(united.GetObjects().begin(), united.GetObjects().end(), objects, valueOf);
  });
}

nlohmann::json
ExtractObjects(const ArrayCall & call, const ExtractOptions & options)
{
  ArrayEngine                           engine(call, options);
  const itk::MedialVoxelSheetExtraction extraction = MakeExtraction(engine, call, options);
  const itk::MedialVoxelBox             image = engine.GetGrid().GetVoxelBox();
  itk::MedialVoxelLabelInput            map(engine.GetSource(),
                                 image,
                                 options.labels->all ? std::vector<std::int64_t>{} : options.labels->values,
                                 extraction.parameters.maximumPoreSize);
  Prepare(engine, options, map);
  itk::MedialVoxelObjectUnion united(map, image.upper, extraction.parameters.maximumPoreSize);
  united.CompleteTopology(options.sameTopology ? std::make_optional(engine.GetGrid()) : std::nullopt);
  united.Begin(image, MakeValues(call));
  itk::MedialVoxelCounts counts;
  for (unsigned int pass = 0; pass < map.GetNumberOfPasses(); ++pass)
  {
    map.ShowPass(pass);
    const auto take = [&united](const itk::MedialVoxelTileResult & tile) { united.TakeTile(tile); };
    counts += engine.Run(map, extraction, take, pass, map.GetNumberOfPasses()).counts;
    united.FinishPass();
  }
  united.Finish();
  Write(united, map.GetTable(), call);
  nlohmann::json numbers = Describe(
    counts, std::nullopt, false, { {}, { {}, DescribeMeasureOnObject(options, call.header) } }, extraction.parameters);
  numbers["objects"] = nlohmann::json::array();
  for (const std::int64_t label : map.GetTable().GetValues())
  {
    const auto object = map.GetTable().GetNumber(label);
    const auto found = united.GetSums().cells.find(object);
    const auto cells = found == united.GetSums().cells.end() ? itk::MedialVoxelObjectUnion::Cells{} : found->second;
    numbers["objects"].push_back({ { "label", label },
                                   { "voxels", map.GetObjectVoxels()[object] },
                                   { "candidate_cells", cells.candidate },
                                   { "medial_cells", cells.medial } });
    if (options.sameTopology)
    {
      numbers["objects"].back()["added_cells"] = cells.added;
    }
  }
  numbers["shared_cells"] = united.GetSums().shared;
  numbers["topology"] = options.sameTopology ? DescribeTopology(united.GetSums().topology) : Json(nullptr);
  return numbers;
}

} // namespace

nlohmann::json
ExtractArray(const ArrayCall & call, const ExtractOptions & options)
{
  CheckFits(call, options);
  return options.labels ? ExtractObjects(call, options) : ExtractOne(call, options);
}

} // end namespace medialvoxel
