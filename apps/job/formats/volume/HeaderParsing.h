// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelHeaderParsing_h
#define medialvoxelHeaderParsing_h

#include "itkMedialVoxelHeaderText.h"

namespace medialvoxel
{

// Functions of the library, for all readers of headers.
using itk::MedialVoxelText::FindDataFile;
using itk::MedialVoxelText::GetDataFileSize;
using itk::MedialVoxelText::HeaderError;
using itk::MedialVoxelText::HeaderFields;
using itk::MedialVoxelText::HeaderLines;
using itk::MedialVoxelText::OpenRegularFile;
using itk::MedialVoxelText::ParseNumbers;
using itk::MedialVoxelText::ParseSizes;
using itk::MedialVoxelText::ParseSpacings;
using itk::MedialVoxelText::RefuseHeader;
using itk::MedialVoxelText::RequireField;

} // end namespace medialvoxel

#endif
