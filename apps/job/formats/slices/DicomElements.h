// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDicomElements_h
#define medialvoxelDicomElements_h

#include "HeaderParsing.h"
#include "InflateReader.h"

#include "itkMedialVoxelFileRegion.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace medialvoxel
{

/** \class DicomElements
 * \brief Reads the elements of a DICOM file one after the other. */
class DicomElements
{
protected:
  static constexpr std::uint32_t UndefinedLength = 0xffffffff;

  // Tags, as group * 65536 + element.
  static constexpr std::uint32_t Item = 0xfffee000;
  static constexpr std::uint32_t EndOfItem = 0xfffee00d;
  static constexpr std::uint32_t EndOfSequence = 0xfffee0dd;

  /** How elements are written. */
  struct Encoding
  {
    bool isExplicit{ true }; ///< with the value representation
    bool isBigEndian{ false };
    bool isRunLength{ false };
  };

  struct Element
  {
    std::uint32_t tag{ 0 };
    std::string   representation; ///< empty: not written
    std::uint32_t length{ 0 };
  };

  explicit DicomElements(const std::filesystem::path & fileName);

  [[noreturn]] void
  Refuse(const std::string & what, HeaderError::Kind kind = HeaderError::Kind::Corrupt) const;

  std::string
  ReadText(std::uint64_t count);

  void
  MoveTo(std::uint64_t position);

  template <typename TNumber>
  TNumber
  ReadNumber()
  {
    return this->ToNumber<TNumber>(this->ReadText(sizeof(TNumber)));
  }

  /** \param bytes as many as the number has */
  template <typename TNumber>
  TNumber
  ToNumber(const std::string & bytes) const
  {
    TNumber number{};
    std::memcpy(&number, bytes.data(), sizeof(number));
    if (m_Encoding.isBigEndian != itk::MachineIsBigEndian())
    {
      itk::SwapComponentBytes(&number, sizeof(number), sizeof(number));
    }
    return number;
  }

  std::uint32_t
  ReadTag();

  Element
  ReadElement();

  /** The bytes of an element are within its parent. */
  void
  RequireRoom(std::uint64_t length, std::uint64_t end) const;

  /** The rest is packed; positions count unpacked bytes from now on. */
  void
  BeginDeflated();

  std::filesystem::path m_FileName;
  std::uint64_t         m_Size{ 0 };
  std::uint64_t         m_Position{ 0 };
  Encoding              m_Encoding;

private:
  std::ifstream                  m_File;
  std::unique_ptr<InflateReader> m_Inflated;
  std::uint64_t                  m_Elements{ 0 };
};

} // end namespace medialvoxel

#endif
