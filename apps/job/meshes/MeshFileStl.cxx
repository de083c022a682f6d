// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshFile.h"

#include "Errors.h"
#include "Text.h"

#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <istream>
#include <map>

namespace medialvoxel
{
namespace
{

constexpr std::size_t HeaderSize = 80;
constexpr std::size_t NormalSize = 12;
constexpr std::size_t TriangleSize = 50;

template <typename TNumber>
TNumber
GetNumber(const char * bytes)
{
  TNumber number;
  std::memcpy(&number, bytes, sizeof(number));
  return number;
}

template <std::size_t VSize>
void
Read(std::istream & input, std::array<char, VSize> & bytes, const std::string & fileName)
{
  if (!input.read(bytes.data(), VSize))
  {
    Fail(ExitStatus::CorruptInput, fileName, ": ends before its last triangle");
  }
}

/** \class Triangles
 * \brief Has corners at one place be one node. */
class Triangles
{
public:
  explicit Triangles(MeshFileBuilder & builder)
    : m_Builder(builder)
  {}

  void
  AddCorner(const itk::MedialVoxelVector3 & place)
  {
    const bool isKey = std::none_of(place.begin(), place.end(), [](const double value) { return std::isnan(value); });
    const auto found = isKey ? m_Numbers.find(place) : m_Numbers.end();
    if (found != m_Numbers.end())
    {
      m_Nodes.push_back(found->second);
      return;
    }
    m_Builder.AddNode(m_Numbers.size() + 1, place);
    m_Nodes.push_back(m_Numbers.size() + 1);
    m_Numbers.emplace(place, m_Numbers.size() + 1);
  }

  /** \return whether the corners were three */
  bool
  Finish()
  {
    const bool isTriangle = m_Nodes.size() == 3;
    if (isTriangle)
    {
      m_Builder.AddElement(++m_NumberOfTriangles, m_Nodes);
    }
    m_Nodes.clear();
    return isTriangle;
  }

private:
  MeshFileBuilder &                                m_Builder;
  std::map<itk::MedialVoxelVector3, std::uint64_t> m_Numbers;
  std::vector<std::uint64_t>                       m_Nodes;
  std::uint64_t                                    m_NumberOfTriangles{ 0 };
};

void
ReadBinary(std::istream & input, const std::uint32_t number, MeshFileBuilder & builder)
{
  Triangles                      triangles(builder);
  std::array<char, TriangleSize> bytes;
  for (std::uint64_t triangle = 1; triangle <= number; ++triangle)
  {
    Read(input, bytes, builder.GetFileName());
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      using Place = std::array<float, 3>;
      const auto place = GetNumber<Place>(bytes.data() + NormalSize + corner * sizeof(Place));
      triangles.AddCorner({ { place[0], place[1], place[2] } });
    }
    triangles.Finish();
  }
}

/** Words but vertex and endfacet say nothing that is not known. */
void
ReadText(std::istream & input, MeshFileBuilder & builder)
{
  Triangles     triangles(builder);
  std::uint64_t number = 0;
  const auto    failAt = [&](const std::string & what) {
    Fail(ExitStatus::CorruptInput,
         builder.GetFileName(),
         ": line ",
         number,
         ": ",
         itk::MedialVoxelText::MakePrintable(what));
  };
  bool isInFacet = false;
  for (std::string line; ReadMeshLine(input, line, builder.GetFileName());)
  {
    ++number;
    const std::vector<std::string> words = SplitAtBlanks(ToLower(line));
    if (!words.empty() && words[0] == "vertex")
    {
      itk::MedialVoxelVector3 place{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto value = axis + 1 < words.size() ? ParseDouble(words[axis + 1]) : std::nullopt;
        if (!value)
        {
          failAt("'" + line + "' is not a vertex of three coordinates");
        }
        place[axis] = *value;
      }
      triangles.AddCorner(place);
    }
    else if (!words.empty() && (words[0] == "facet" || words[0] == "endfacet"))
    {
      const bool isEnd = words[0] == "endfacet";
      if (isEnd != isInFacet || (isEnd && !triangles.Finish()))
      {
        failAt("the facet has not three vertices");
      }
      isInFacet = !isEnd;
    }
  }
  if (isInFacet)
  {
    Fail(ExitStatus::CorruptInput, builder.GetFileName(), ": ends before its last triangle");
  }
}

} // namespace

void
ReadStlMesh(std::istream & input, MeshFileBuilder & builder)
{
  input.seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(input.tellg());
  input.seekg(0);
  std::array<char, HeaderSize + sizeof(std::uint32_t)> header;
  Read(input, header, builder.GetFileName());
  const auto        triangles = GetNumber<std::uint32_t>(header.data() + HeaderSize);
  const bool        hasSize = size == header.size() + std::uint64_t{ triangles } * TriangleSize;
  const std::string mark = "solid";
  // The comment of a binary file may begin with the same word, but its number of triangles has bytes of 0.
  const bool isText = !hasSize && std::equal(mark.begin(), mark.end(), header.begin()) &&
                      std::find(header.begin(), header.end(), '\0') == header.end();
  if (isText)
  {
    input.seekg(0);
    ReadText(input, builder);
    return;
  }
  ReadBinary(input, triangles, builder);
  if (!hasSize)
  {
    Fail(ExitStatus::CorruptInput, builder.GetFileName(), ": is not a binary STL file of ", triangles, " triangles");
  }
}

} // end namespace medialvoxel
