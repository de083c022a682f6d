// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPackedNumbers_h
#define medialvoxelPackedNumbers_h

#include "LengthHistogram.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
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

  /** Saves a number of any type, or a histogram. NumberReader reads it under the same name, so one function lists the
   * saved members. */
  template <typename TNumber>
  void
  Exchange(const TNumber & number)
  {
    if constexpr (std::is_same_v<TNumber, float>)
    {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &number, sizeof(bits));
      this->Add(bits);
    }
    else if constexpr (std::is_signed_v<TNumber>)
    {
      this->AddSigned(number);
    }
    else
    {
      this->Add(number);
    }
  }
  void
  Exchange(const LengthHistogram & histogram);

  /** The size of a list, which must be equal at both ends. */
  void
  ExchangeSize(std::size_t size)
  {
    this->Add(size);
  }

  /** The number of bytes, eight of them, and the packed bytes. */
  std::string
  Pack() const;

private:
  std::string m_Bytes;
};

/** \class NumberReader
 * \brief Reads saved numbers; throws JobError Failure when no NumberWriter made them. */
class NumberReader
{
public:
  /** \param maximumSize more than that are not unpacked */
  NumberReader(const std::string & packed, std::uint64_t maximumSize);

  std::uint64_t
  Get();

  std::int64_t
  GetSigned();

  /** The length of a list, each of whose elements takes a byte or more. */
  std::size_t
  GetLength();

  template <typename TNumber>
  void
  Exchange(TNumber & number)
  {
    if constexpr (std::is_same_v<TNumber, float>)
    {
      const auto bits = static_cast<std::uint32_t>(this->Get());
      std::memcpy(&number, &bits, sizeof(bits));
    }
    else if constexpr (std::is_signed_v<TNumber>)
    {
      number = static_cast<TNumber>(this->GetSigned());
    }
    else
    {
      number = static_cast<TNumber>(this->Get());
    }
  }
  /** Adds the saved numbers. */
  void
  Exchange(LengthHistogram & histogram);

  void
  ExchangeSize(std::size_t size);

  void
  CheckEnd() const;

private:
  std::string m_Bytes;
  std::size_t m_Position{ 0 };
};

/** \throw JobError Failure, always */
[[noreturn]] void
RefuseSaved();

} // end namespace medialvoxel

#endif
