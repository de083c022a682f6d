// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshFile.h"

#include "Errors.h"
#include "Text.h"

#include "itkMedialVoxelHeaderText.h"

#include <cstring>
#include <istream>
#include <limits>
#include <map>
#include <optional>

namespace medialvoxel
{
namespace
{

constexpr std::size_t LargestHead = std::size_t{ 1 } << 20;
constexpr char        DataMark[] = "<AppendedData encoding=\"raw\">";

/** Bytes that are read at a time: numbers that a file announces take memory only as they come. */
constexpr std::uint64_t BlockSize = std::uint64_t{ 1 } << 16;

/** An element of the head, with its attributes. */
struct Tag
{
  std::string                        name;
  std::map<std::string, std::string> attributes;

  std::string
  Get(const std::string & attribute) const
  {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? "" : found->second;
  }
};

/** \class VtkInput
 * \brief The head of a file, and the arrays behind it. */
class VtkInput
{
public:
  VtkInput(std::istream & input, const std::string & fileName)
    : m_Input(input)
    , m_FileName(fileName)
  {
    this->ReadHead();
  }

  [[noreturn]] void
  FailWith(const std::string & what) const
  {
    Fail(ExitStatus::CorruptInput, m_FileName, ": ", itk::MedialVoxelText::MakePrintable(what));
  }

  const std::vector<Tag> &
  GetTags() const
  {
    return m_Tags;
  }

  /** The one element of a name. */
  const Tag &
  GetTag(const std::string & name, const std::string & attribute = "", const std::string & value = "") const
  {
    const Tag * found = nullptr;
    for (const Tag & tag : m_Tags)
    {
      if (tag.name == name && (attribute.empty() || tag.Get(attribute) == value))
      {
        if (found != nullptr)
        {
          this->FailWith("has more than one element " + name + " " + value);
        }
        found = &tag;
      }
    }
    if (found == nullptr)
    {
      this->FailWith("has no element " + name + " " + value);
    }
    return *found;
  }

  std::uint64_t
  GetCount(const Tag & tag, const std::string & attribute) const
  {
    const auto value = ParseInteger(tag.Get(attribute));
    if (!value || *value < 0)
    {
      this->FailWith(attribute + " is '" + tag.Get(attribute) + "', not a number of bytes, points or faces");
    }
    return static_cast<std::uint64_t>(*value);
  }

  /** The numbers of an array, of one of some types. */
  template <typename TNumber>
  std::vector<TNumber>
  ReadArray(const Tag & array, const std::string & type)
  {
    const std::string name = array.Get("Name");
    if (array.Get("format") != "appended" || array.Get("type") != type)
    {
      this->FailWith("its array " + name + " is not of appended " + type);
    }
    const std::uint64_t offset = this->GetCount(array, "offset");
    if (offset > static_cast<std::uint64_t>(std::numeric_limits<std::streamoff>::max()) - m_Begin)
    {
      this->FailWith("its array " + name + " begins behind its end");
    }
    m_Input.clear();
    m_Input.seekg(static_cast<std::streamoff>(m_Begin + offset));
    std::uint64_t bytes = 0;
    this->ReadBytes(name, &bytes, sizeof(bytes));
    if (bytes % sizeof(TNumber) != 0)
    {
      this->FailWith("its array " + name + " has " + std::to_string(bytes) + " bytes");
    }
    std::vector<TNumber> numbers;
    for (std::uint64_t left = bytes / sizeof(TNumber); left > 0;)
    {
      const auto count = static_cast<std::size_t>(std::min(left, BlockSize / sizeof(TNumber)));
      numbers.resize(numbers.size() + count);
      this->ReadBytes(name, numbers.data() + numbers.size() - count, count * sizeof(TNumber));
      left -= count;
    }
    return numbers;
  }

private:
  void
  ReadHead()
  {
    std::string head;
    for (std::string line; head.find(DataMark) == std::string::npos;)
    {
      if (head.size() > LargestHead || !ReadMeshLine(m_Input, line, m_FileName))
      {
        this->FailWith("has no appended raw data; VTK XML is read as the program writes it");
      }
      head += line + "\n";
    }
    while (m_Input.peek() == ' ' || m_Input.peek() == '\n')
    {
      m_Input.get();
    }
    if (m_Input.get() != '_')
    {
      this->FailWith("its appended data does not begin with _");
    }
    m_Begin = static_cast<std::uint64_t>(m_Input.tellg());
    this->ParseTags(head);
    const Tag & file = this->GetTag("VTKFile");
    if (file.Get("byte_order") != "LittleEndian" || file.Get("header_type") != "UInt64" ||
        !file.Get("compressor").empty())
    {
      this->FailWith("is not of the byte order LittleEndian, the header type UInt64 and without compression");
    }
  }

  /** Elements that begin, without what is between them. */
  void
  ParseTags(const std::string & head)
  {
    for (std::size_t begin = head.find('<'); begin != std::string::npos; begin = head.find('<', begin + 1))
    {
      const std::size_t end = head.find('>', begin);
      if (end == std::string::npos || head[begin + 1] == '/' || head[begin + 1] == '?')
      {
        continue;
      }
      std::string text = head.substr(begin + 1, end - begin - 1);
      Tag         tag{ text.substr(0, text.find_first_of(" /")), {} };
      for (std::size_t sign = text.find("=\""); sign != std::string::npos; sign = text.find("=\"", sign))
      {
        const std::size_t name = text.find_last_of(" ", sign) + 1;
        const std::size_t quote = text.find('"', sign + 2);
        if (quote == std::string::npos)
        {
          break;
        }
        tag.attributes[text.substr(name, sign - name)] = text.substr(sign + 2, quote - sign - 2);
        sign = quote;
      }
      m_Tags.push_back(std::move(tag));
    }
  }

  void
  ReadBytes(const std::string & name, void * bytes, std::size_t size)
  {
    if (!m_Input.read(static_cast<char *>(bytes), static_cast<std::streamsize>(size)))
    {
      this->FailWith("ends before its array " + name);
    }
  }

  std::istream &   m_Input;
  std::string      m_FileName;
  std::vector<Tag> m_Tags;
  std::uint64_t    m_Begin{ 0 }; ///< of the arrays
};

std::vector<double>
ReadCoordinates(VtkInput & input)
{
  // Its array is the one behind it.
  const std::vector<Tag> & tags = input.GetTags();
  const Tag * const        points = &input.GetTag("Points");
  if (points == &tags.back() || points[1].name != "DataArray" || points[1].Get("NumberOfComponents") != "3")
  {
    input.FailWith("its points have no array of three components");
  }
  if (points[1].Get("type") == "Float64")
  {
    return input.ReadArray<double>(points[1], "Float64");
  }
  const std::vector<float> coordinates = input.ReadArray<float>(points[1], "Float32");
  return { coordinates.begin(), coordinates.end() };
}

/** The faces from the first on: corners up to each end. */
void
AddFaces(VtkInput & input, const std::uint64_t number, MeshFileBuilder & builder)
{
  const auto corners = input.ReadArray<std::int64_t>(input.GetTag("DataArray", "Name", "connectivity"), "Int64");
  const auto ends = input.ReadArray<std::int64_t>(input.GetTag("DataArray", "Name", "offsets"), "Int64");
  if (ends.size() != number)
  {
    input.FailWith("has " + std::to_string(ends.size()) + " ends of faces for " + std::to_string(number) + " faces");
  }
  std::int64_t begin = 0;
  for (std::size_t face = 0; face < ends.size(); ++face)
  {
    const std::int64_t end = ends[face];
    if (end < begin || end > static_cast<std::int64_t>(corners.size()) || end - begin < 3 || end - begin > 4)
    {
      input.FailWith("face " + std::to_string(face + 1) + " has not 3 or 4 corners");
    }
    std::vector<std::uint64_t> nodes;
    for (; begin < end; ++begin)
    {
      // Those below 0 become numbers that are missing.
      nodes.push_back(static_cast<std::uint64_t>(corners[static_cast<std::size_t>(begin)]));
    }
    builder.AddElement(face + 1, nodes);
  }
}

} // namespace

void
ReadVtkMesh(std::istream & stream, MeshFileBuilder & builder)
{
  VtkInput                  input(stream, builder.GetFileName());
  const Tag &               piece = input.GetTag("Piece");
  const std::vector<double> coordinates = ReadCoordinates(input);
  const std::uint64_t       points = input.GetCount(piece, "NumberOfPoints");
  if (coordinates.size() % 3 != 0 || coordinates.size() / 3 != points)
  {
    input.FailWith("has " + std::to_string(coordinates.size()) + " coordinates for " + std::to_string(points) +
                   " points");
  }
  for (std::uint64_t point = 0; point < points; ++point)
  {
    const double * const place = coordinates.data() + 3 * point;
    builder.AddNode(point, { { place[0], place[1], place[2] } });
  }
  const bool isPolyData = input.GetTag("VTKFile").Get("type") == "PolyData";
  AddFaces(input, input.GetCount(piece, isPolyData ? "NumberOfPolys" : "NumberOfCells"), builder);
}

} // end namespace medialvoxel
