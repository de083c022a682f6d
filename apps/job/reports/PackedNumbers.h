// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPackedNumbers_h
#define medialvoxelPackedNumbers_h

#include "LengthHistogram.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace medialvoxel
{

/** \class NumberWriter
 * \brief Appends numbers to bytes that any machine reads: variable lengths of seven bits, low ones first, packed by
 * zlib. */
class NumberWriter
{
public:
  void
  Add(std::uint64_t number);

  /** Small numbers of either sign stay short. */
  void
  AddSigned(std::int64_t number);

  void
  AddAll(const std::vector<std::uint64_t> & numbers);

  /** The number of bytes, eight of them, and the packed bytes. */
  std::string
  Pack() const;

private:
  std::string m_Bytes;
};

/** \class NumberReader
 * \brief Takes them back; throws JobError Failure when they are not what a NumberWriter made. */
class NumberReader
{
public:
  /** \param mostBytes more than that are not unpacked */
  NumberReader(const std::string & packed, std::uint64_t mostBytes);

  std::uint64_t
  Get();

  std::int64_t
  GetSigned();

  /** The length of a list, each of whose elements takes a byte or more. */
  std::size_t
  GetLength();

  void
  AddTo(LengthHistogram & histogram);

  void
  CheckEnd() const;

private:
  std::string m_Bytes;
  std::size_t m_Position{ 0 };
};

/** \throw JobError Failure, always */
[[noreturn]] void
RefusePart();

} // end namespace medialvoxel

#endif
