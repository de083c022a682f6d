// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ColorMap.h"
#include "MeshElements.h"
#include "MeshWriters.h"
#include "Text.h"
#include "Version.h"

#include "itkMedialVoxelElementary.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace medialvoxel
{
namespace
{

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr std::uint32_t Magic = 0x46546c67;
constexpr std::uint32_t FormatVersion = 2;
constexpr std::uint32_t JsonChunk = 0x4e4f534a;
constexpr std::uint32_t BinaryChunk = 0x004e4942;
constexpr std::uint32_t HeaderSize = 12;
constexpr std::uint32_t ChunkHeaderSize = 8;
constexpr int           UnsignedByte = 5121;
constexpr int           UnsignedInt = 5125;
constexpr int           Float = 5126;
constexpr int           ArrayBuffer = 34962;
constexpr int           ElementArrayBuffer = 34963;

constexpr Color Gray{ 128, 128, 128 }; ///< where the thickness is not known

/** The description before the numbers of the file. */
struct Extent
{
  std::array<float, 3> least;
  std::array<float, 3> greatest;
  ThicknessRange       thickness; ///< of the vertices
};

bool
IsKnown(float thickness)
{
  return std::isfinite(thickness) && thickness > 0.0f;
}

Extent
FindExtent(MeshReader & reader)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Extent          extent{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity }, { infinity, 0.0 } };
  reader.ForEachVertex([&extent](std::uint64_t, const auto & vertex) {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto coordinate = static_cast<float>(vertex.position[axis]);
      extent.least[axis] = std::min(extent.least[axis], coordinate);
      extent.greatest[axis] = std::max(extent.greatest[axis], coordinate);
    }
    if (IsKnown(vertex.thickness))
    {
      extent.thickness.low = std::min<double>(extent.thickness.low, vertex.thickness);
      extent.thickness.high = std::max<double>(extent.thickness.high, vertex.thickness);
    }
  });
  extent.thickness.low = std::min(extent.thickness.low, extent.thickness.high);
  return extent;
}

/** The specification has colors of vertices linear, not as screens have them. */
std::uint8_t
ToLinear(std::uint8_t component)
{
  const double encoded = component / 255.0;
  const double linear =
    encoded <= 0.04045 ? encoded / 12.92 : itk::MedialVoxelElementary::Power((encoded + 0.055) / 1.055, 2.4);
  return static_cast<std::uint8_t>(std::lround(255.0 * linear));
}

Color
GetColor(const ThicknessRange & range, float thickness)
{
  if (!IsKnown(thickness))
  {
    return Gray;
  }
  const double width = range.high - range.low;
  return GetMapColor(width > 0.0 ? (thickness - range.low) / width : 0.5);
}

/** A number that is not finite is not allowed in the file. */
float
ToFinite(float number)
{
  return std::isfinite(number) ? number : 0.0f;
}

/** "_RAY_THICKNESS". */
std::string
GetAttributeName(const std::string & name)
{
  std::string attribute = "_" + name;
  std::transform(attribute.begin(), attribute.end(), attribute.begin(), [](char letter) {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  });
  return attribute;
}

/** \class GltfDescription
 * \brief The JSON part: where each array of numbers lies, one after the other. */
class GltfDescription
{
public:
  /** Adds an array and returns its number. */
  std::size_t
  AddArray(int componentType, const char * type, std::uint64_t count, std::uint64_t bytesPerElement, int target)
  {
    m_Views.push_back(
      { { "buffer", 0 }, { "byteOffset", m_Bytes }, { "byteLength", count * bytesPerElement }, { "target", target } });
    m_Bytes += count * bytesPerElement;
    m_Accessors.push_back({ { "bufferView", m_Views.size() - 1 },
                            { "componentType", componentType },
                            { "count", count },
                            { "type", type } });
    return m_Accessors.size() - 1;
  }

  Json &
  GetAccessor(std::size_t number)
  {
    return m_Accessors[number];
  }

  std::uint64_t
  GetBytes() const
  {
    return m_Bytes;
  }

  /** \param mesh nothing: the surface has no faces, and the file shows nothing */
  std::string
  Finish(const Json & mesh) const
  {
    Json json{ { "asset", { { "version", "2.0" }, { "generator", "MedialVoxel " + GetVersion() } } },
               { "scene", 0 },
               { "scenes", Json::array({ Json::object() }) } };
    if (!mesh.is_null())
    {
      json["scenes"][0]["nodes"] = { 0 };
      json["nodes"] = Json::array({ { { "mesh", 0 } } });
      json["meshes"] = Json::array({ mesh });
      json["materials"] =
        Json::array({ { { "pbrMetallicRoughness", { { "metallicFactor", 0 }, { "roughnessFactor", 1 } } },
                        { "doubleSided", true } } });
      json["buffers"] = Json::array({ { { "byteLength", m_Bytes } } });
      json["bufferViews"] = m_Views;
      json["accessors"] = m_Accessors;
    }
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' '); // chunks have whole words
    return text;
  }

private:
  Json          m_Views = Json::array();
  Json          m_Accessors = Json::array();
  std::uint64_t m_Bytes{ 0 };
};

void
WriteNumbers(MeshReader &             reader,
             const MeshWriteOptions & options,
             const ThicknessRange &   colors,
             BufferedOutput &         output)
{
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) {
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.LittleEndian(static_cast<float>(coordinate)); });
  });
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) {
    for (const std::uint8_t component : GetColor(colors, vertex.thickness))
    {
      output.LittleEndian(ToLinear(component));
    }
    output.LittleEndian(std::numeric_limits<std::uint8_t>::max());
  });
  reader.ForEachVertex([&](std::uint64_t, const auto & vertex) { output.LittleEndian(ToFinite(vertex.thickness)); });
  for (const VertexValues * const array : options.vertexArrays)
  {
    reader.ForEachVertex(
      [&](std::uint64_t number, const auto &) { output.LittleEndian(ToFinite(array->Get(number))); });
  }
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    for (const auto & triangle : GetTriangles(reader, face))
    {
      for (const auto corner : triangle)
      {
        output.LittleEndian(static_cast<std::uint32_t>(face.vertices[corner]));
      }
    }
  });
}

} // namespace

void
WriteMeshGltf(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(4 + options.vertexArrays.size(), 1);
  const MeshSpool &    surface = reader.GetMesh();
  const std::uint64_t  vertices = surface.GetNumberOfVertices();
  const std::uint64_t  triangles = surface.GetNumberOfTriangles() + 2 * surface.GetNumberOfQuads();
  const Extent         extent = FindExtent(reader);
  const ThicknessRange colors = options.colorRange.value_or(extent.thickness);

  GltfDescription description;
  Json            mesh;
  if (triangles > 0)
  {
    Json              attributes;
    const std::size_t position = description.AddArray(Float, "VEC3", vertices, 3 * sizeof(float), ArrayBuffer);
    description.GetAccessor(position)["min"] = extent.least;
    description.GetAccessor(position)["max"] = extent.greatest;
    attributes["POSITION"] = position;
    const std::size_t color = description.AddArray(UnsignedByte, "VEC4", vertices, 4, ArrayBuffer);
    description.GetAccessor(color)["normalized"] = true;
    attributes["COLOR_0"] = color;
    attributes["_THICKNESS"] = description.AddArray(Float, "SCALAR", vertices, sizeof(float), ArrayBuffer);
    for (const VertexValues * const array : options.vertexArrays)
    {
      attributes[GetAttributeName(array->GetName())] =
        description.AddArray(Float, "SCALAR", vertices, sizeof(float), ArrayBuffer);
    }
    const std::size_t corners =
      description.AddArray(UnsignedInt, "SCALAR", 3 * triangles, sizeof(std::uint32_t), ElementArrayBuffer);
    mesh = { { "primitives",
               Json::array({ { { "attributes", attributes }, { "indices", corners }, { "material", 0 } } }) },
             { "extras", { { "thickness_color_range", { colors.low, colors.high } }, { "unit", options.unit } } } };
  }
  const std::string   text = description.Finish(mesh);
  const std::uint64_t binary = description.GetBytes() > 0 ? ChunkHeaderSize + description.GetBytes() : 0;
  output.LittleEndian(Magic);
  output.LittleEndian(FormatVersion);
  output.LittleEndian(static_cast<std::uint32_t>(HeaderSize + ChunkHeaderSize + text.size() + binary));
  output.LittleEndian(static_cast<std::uint32_t>(text.size()));
  output.LittleEndian(JsonChunk);
  output.Text(text);
  if (binary > 0)
  {
    output.LittleEndian(static_cast<std::uint32_t>(description.GetBytes()));
    output.LittleEndian(BinaryChunk);
    WriteNumbers(reader, options, colors, output);
  }
}

} // end namespace medialvoxel
