// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrFields_h
#define medialvoxelZarrFields_h

#include "HeaderParsing.h"
#include "JsonFile.h"
#include "ZarrMetadata.h"

#include <nlohmann/json.hpp>

#include <string>

namespace medialvoxel
{

/** \class ZarrFields
 * \brief Metadata that the versions of Zarr have in common. All throw HeaderError, which names the file. */
class ZarrFields
{
public:
  using Json = nlohmann::json;
  using Path = std::filesystem::path;

  /** Reads JSON and hands it to a function; a value that has another type than it must have is refused. */
  template <typename TFunction>
  static auto
  WithJson(const Path & fileName, TFunction && function)
  {
    constexpr std::uint64_t maximumSize = std::uint64_t{ 1 } << 22;
    const Json              value = ReadJsonFile(fileName, maximumSize);
    try
    {
      return function(value);
    }
    catch (const Json::exception & error)
    {
      RefuseHeader(fileName, std::string("it is not the metadata of a Zarr folder: ") + error.what());
    }
  }

  /** A value as text for a message, not too long. */
  static std::string
  Show(const Json & value);

  ZarrFields(const Path & fileName, const Json & json)
    : m_FileName(fileName)
    , m_Json(json)
  {}

  [[noreturn]] void
  Refuse(const std::string & problem) const
  {
    RefuseHeader(m_FileName, problem);
  }

  const Json &
  At(const char * name) const
  {
    return m_Json.at(name);
  }

  const Json &
  GetJson() const
  {
    return m_Json;
  }

  /** Sets sizes of an array and its chunks. The last axes are the axes of space, the others have the length 1.
   * \param dimension as ReadZarrArray() */
  void
  SetLengths(const Json & shape, const Json & chunks, unsigned int dimension, ZarrGrid & grid) const;

  /** The lengths along x, y and z of chunks of chunks, or shards. */
  ZarrIndex
  ReadChunkLengths(const Json & lengths, const ZarrGrid & grid) const;

  /** The places of the axes of space among all, from the fastest on, for the order of all from the slowest on. */
  std::array<unsigned int, 3>
  ReadAxisOrder(const std::vector<std::uint64_t> & order, const ZarrGrid & grid) const;

  /** Sets the fill value of an array whose type is set. */
  void
  SetFillValue(const Json & fill, ZarrArray & array) const;

  char
  ReadSeparator(const Json & separator) const;

  /** Adds a codec of the chunks. \param options of it, for a description */
  void
  AddCodec(const Json & name, const Json & options, int version, ZarrArray & array) const;

  /** Refuses chunks that take too much memory, once all else is set. */
  void
  CheckChunkSize(const ZarrArray & array) const;

private:
  std::vector<std::uint64_t>
  ReadLengths(const Json & values, const char * name) const;

  const Path & m_FileName;
  const Json & m_Json;
};

/** Read the metadata of versions 2 and 3. */
ZarrArray
ReadZarrArray2(const ZarrFields & fields, unsigned int dimension);
ZarrArray
ReadZarrArray3(const ZarrFields & fields, unsigned int dimension);

} // end namespace medialvoxel

#endif
