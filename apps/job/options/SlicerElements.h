// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSlicerElements_h
#define medialvoxelSlicerElements_h

#include <string>

namespace medialvoxel
{

/** Elements of the XML of the module for 3D Slicer, with their attributes. */
inline std::string
SlicerImage(const std::string & type, const std::string & extensions)
{
  return "image type=\"" + type + "\" fileExtensions=\"" + extensions + "\"";
}

/** An image beside the input. */
inline std::string
SlicerOutput(const std::string & type, const std::string & extensions = ".mha,.mhd,.nrrd,.nhdr")
{
  return SlicerImage(type, extensions) + " reference=\"inputVolume\"";
}

inline std::string
SlicerFile(const std::string & extensions)
{
  return "file fileExtensions=\"" + extensions + "\"";
}

/** The range of whole numbers. */
inline std::string
SlicerLimits(const std::string & least, const std::string & most)
{
  return "<constraints>\n        <minimum>" + least + "</minimum>\n        <maximum>" + most +
         "</maximum>\n        <step>1</step>\n      </constraints>";
}

} // end namespace medialvoxel

#endif
