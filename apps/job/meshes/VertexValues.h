// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelVertexValues_h
#define medialvoxelVertexValues_h

#include "ScratchFile.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace medialvoxel
{

/** \class VertexValues
 * \brief A number for each vertex of a surface, in a scratch file. */
class VertexValues
{
public:
  /** In the scratch file. */
  static constexpr std::uint64_t VertexSize = sizeof(float);

  /** \param folder as of MeshSpool \param name in files: small letters and underscores
   * \throw JobError Refused when the folder is missing or cannot be written. */
  VertexValues(const std::filesystem::path & folder, std::string name);

  const std::string &
  GetName() const
  {
    return m_Name;
  }

  /** Numbers of the vertices from number \a first on, from any threads. \throw JobError Failure. */
  void
  Put(std::uint64_t first, const std::vector<float> & numbers);

  /** The values of \a count existing vertices from number \a first on. \throw JobError Failure. */
  void
  Read(std::uint64_t first, std::uint64_t count, std::vector<float> & numbers) const;

  /** The value of an existing vertex; fast when vertices are asked for in their order. \throw JobError Failure. */
  float
  Get(std::uint64_t vertex) const;

private:
  ScratchFile                m_File;
  std::string                m_Name;
  std::atomic<std::uint64_t> m_Size{ 0 };
  mutable std::vector<float> m_Block; ///< that was read last
  mutable std::uint64_t      m_First{ 0 };
};

} // end namespace medialvoxel

#endif
