// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNrrdHeaderPrivate_h
#define itkMedialVoxelNrrdHeaderPrivate_h

#include "itkMedialVoxelNrrdHeader.h"

#include <limits>

namespace itk
{

/** Fills in spacing, origin, direction, space and measurement frame from the fields and sizes of a header. */
void
ReadMedialVoxelNrrdGeometry(MedialVoxelNrrdHeader & header);

/** A whole number within limits. \throw MedialVoxelText::HeaderError Corrupt with the name, the text and the limits */
std::int64_t
ReadNrrdWholeNumber(const std::filesystem::path & fileName,
                    const std::string &           name,
                    const std::string &           text,
                    std::int64_t                  least,
                    std::int64_t                  greatest = std::numeric_limits<std::int64_t>::max());

/** Whether the lines after the field `data file` are names of files. */
bool
IsNrrdFileList(const std::string & dataFile);

/** The data files that the field `data file` names, in their order; the file of the header without that field.
 * \param sizes sizes of all axes of the file */
std::vector<std::filesystem::path>
ListNrrdDataFiles(const MedialVoxelNrrdHeader &      header,
                  const std::vector<std::string> &   listedFiles,
                  const std::vector<std::uint64_t> & sizes);

} // end namespace itk

#endif
