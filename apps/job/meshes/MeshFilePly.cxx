// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshFile.h"

#include "Errors.h"
#include "Text.h"

#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <cstring>
#include <istream>

namespace medialvoxel
{
namespace
{

struct Property
{
  std::string name;
  std::string type;
  std::string countType; ///< of a list; empty: a single value
};

struct Group
{
  std::string           name;
  std::uint64_t         number{ 0 };
  std::vector<Property> properties;
};

/** \class PlyInput
 * \brief Header and values of a binary file of little endian. */
class PlyInput
{
public:
  PlyInput(std::istream & input, const std::string & fileName)
    : m_Input(input)
    , m_FileName(fileName)
  {}

  [[noreturn]] void
  FailWith(const std::string & what) const
  {
    Fail(ExitStatus::CorruptInput, m_FileName, ": ", itk::MedialVoxelText::MakePrintable(what));
  }

  std::vector<Group>
  ReadHeader()
  {
    std::vector<Group> groups;
    std::string        line;
    bool               isBinary = false;
    for (bool first = true; ReadMeshLine(m_Input, line, m_FileName); first = false)
    {
      const auto words = SplitAtBlanks(line);
      if (first && line != "ply")
      {
        this->FailWith("is not a PLY file");
      }
      if (words.size() == 1 && words[0] == "end_header")
      {
        break;
      }
      isBinary = isBinary || line == "format binary_little_endian 1.0";
      if (words.size() == 3 && words[0] == "element")
      {
        groups.push_back({ std::string(words[1]), this->ToCount(std::string(words[2])), {} });
      }
      else if (words.size() >= 3 && words[0] == "property" && !groups.empty())
      {
        const bool isList = words[1] == "list" && words.size() == 5;
        groups.back().properties.push_back({ std::string(words.back()),
                                             std::string(words[words.size() - 2]),
                                             isList ? std::string(words[2]) : std::string() });
      }
    }
    if (!isBinary)
    {
      this->FailWith("is not of the format binary_little_endian 1.0");
    }
    for (const Group & group : groups)
    {
      this->CheckGroup(group);
    }
    return groups;
  }

  double
  ReadValue(const std::string & type)
  {
    const bool isUnsigned = type.front() == 'u';
    if (type == "float" || type == "float32")
    {
      return this->Read<float>();
    }
    if (type == "double" || type == "float64")
    {
      return this->Read<double>();
    }
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8")
    {
      return isUnsigned ? this->Read<std::uint8_t>() : this->Read<std::int8_t>();
    }
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16")
    {
      return isUnsigned ? this->Read<std::uint16_t>() : this->Read<std::int16_t>();
    }
    if (type == "int" || type == "uint" || type == "int32" || type == "uint32")
    {
      return isUnsigned ? this->Read<std::uint32_t>() : this->Read<std::int32_t>();
    }
    this->FailWith("has a property of the unknown type " + type);
  }

private:
  /** Elements without properties take no bytes, so that the end of the file does not end them. */
  void
  CheckGroup(const Group & group) const
  {
    if (group.number > 0 && group.properties.empty())
    {
      this->FailWith("its elements " + group.name + " have no properties");
    }
    const bool hasList = std::any_of(group.properties.begin(), group.properties.end(), [](const Property & property) {
      return !property.countType.empty();
    });
    if (group.name == "vertex" && hasList)
    {
      this->FailWith("a property of its vertices is a list, which is not read");
    }
  }

  std::uint64_t
  ToCount(const std::string & text) const
  {
    const auto value = ParseInteger(text);
    if (!value || *value < 0)
    {
      this->FailWith("'" + text + "' is not a number of elements");
    }
    return static_cast<std::uint64_t>(*value);
  }

  template <typename TValue>
  TValue
  Read()
  {
    std::array<char, sizeof(TValue)> bytes;
    TValue                           value;
    if (!m_Input.read(bytes.data(), bytes.size()))
    {
      this->FailWith("ends before its last value");
    }
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }

  std::istream & m_Input;
  std::string    m_FileName;
};

void
ReadVertex(PlyInput & input, const Group & group, std::uint64_t number, MeshFileBuilder & builder)
{
  itk::MedialVoxelVector3 point{};
  for (const Property & property : group.properties)
  {
    const double value = input.ReadValue(property.type);
    const auto   axis = std::string("xyz").find(property.name);
    if (property.name.size() == 1 && axis != std::string::npos)
    {
      point[axis] = value;
    }
  }
  builder.AddNode(number, point);
}

/** The number of a node, from a place that may be any number; 0 is that of none. */
std::uint64_t
ToNode(const double place)
{
  constexpr double most = 4294967295.0;
  return place >= 0.0 && place <= most ? static_cast<std::uint64_t>(place) + 1 : 0;
}

void
ReadFace(PlyInput & input, const Group & group, std::uint64_t number, MeshFileBuilder & builder)
{
  for (const Property & property : group.properties)
  {
    const double               count = property.countType.empty() ? 1 : input.ReadValue(property.countType);
    std::vector<std::uint64_t> nodes;
    for (double k = 0; k < count; ++k)
    {
      nodes.push_back(ToNode(input.ReadValue(property.type)));
    }
    if (property.name == "vertex_indices" || property.name == "vertex_index")
    {
      if (nodes.size() < 3 || nodes.size() > 4)
      {
        input.FailWith("face " + std::to_string(number) + " has " + std::to_string(nodes.size()) +
                       " corners, not 3 or 4");
      }
      builder.AddElement(number, nodes);
    }
  }
}

} // namespace

void
ReadPlyMesh(std::istream & stream, MeshFileBuilder & builder)
{
  PlyInput input(stream, builder.GetFileName());
  for (const Group & group : input.ReadHeader())
  {
    for (std::uint64_t number = 1; number <= group.number; ++number)
    {
      if (group.name == "vertex")
      {
        ReadVertex(input, group, number, builder);
      }
      else
      {
        ReadFace(input, group, number, builder);
      }
    }
  }
}

} // end namespace medialvoxel
