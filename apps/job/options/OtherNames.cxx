// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OtherNames.h"

#include "SuggestName.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** A name that is no option, and the option that does what was meant. */
struct OtherName
{
  const char * name;
  const char * option;
  const char * example{ "" }; ///< its value, where this is another than before
};

/** Names that were options once. */
constexpr OtherName FormerNames[] = {
  { "--level", "--resolution" },
  { "--levels", "--materials" },
  { "--minimum-thickness", "--min-thickness" },
  { "--maximum-thickness", "--max-thickness" },
  { "--maximum-distance", "--max-distance" },
  { "--smallest-place", "--thin-below", " T,,A" },
  { "--min-place-area", "--thin-below", " T,,A" },
  { "--smallest-component", "--min-component-size" },
  { "--voxel-units", "lengths with the unit", " vx, such as --thickness 3vx" },
  { "--thickness-csv", "thickness.histogram of --report" },
  { "--log-level", "the first word of each line of --log-file" },
  { "--section-width", "--sections" },
  { "--thickness-at", "--sections", " nodes" },
  { "--zarr-compression", "--compress" },
  { "--raw-spacing", "--spacing" },
  { "--raw-header", "--raw-type", " TYPE:BYTES" },
  { "--raw-big-endian", "--raw-type", " TYPE:big" },
};

/** Names that a reader of other programs tries. */
constexpr OtherName UsualNames[] = {
  { "--threshold", "--lower" },
  { "--iso", "--lower" },
  { "--iso-value", "--lower" },
  { "--isovalue", "--lower" },
  { "--lower-threshold", "--lower" },
  { "--upper-threshold", "--upper" },
  { "--min", "--lower" },
  { "--max", "--upper" },
  { "--otsu", "--lower", " otsu" },
  { "--mask", "--labels" },
  { "--min-wall", "--thin-below" },
  { "--min-wall-thickness", "--thin-below" },
  { "--max-wall-thickness", "--thick-above" },
  { "--tolerance", "--thin-below" },
  { "--wall-thickness", "--thickness-map" },
  { "--output", "OUTPUT" },
  { "--json", "--report" },
  { "--page", "--html" },
  { "--picture", "--preview" },
  { "--png", "--preview" },
  { "--csv", "--places" },
  { "--voxel-size", "--spacing" },
  { "--size", "--raw-size" },
  { "--dtype", "--raw-type" },
  { "--type", "--raw-type" },
  { "--cpus", "--threads" },
  { "--jobs", "--threads" },
  { "--ram", "--memory" },
  { "--force", "--overwrite" },
  { "--silent", "--quiet" },
  { "--verbose", "--progress" },
};

} // namespace

std::string
DescribeUnknownOption(const std::string & name, const std::string & command, const std::vector<std::string> & names)
{
  for (const OtherName & former : FormerNames)
  {
    if (former.name == name)
    {
      return name + " is now " + former.option + former.example;
    }
  }
  const std::string problem = "'" + name + "' is not an option of " + command;
  for (const OtherName & usual : UsualNames)
  {
    if (usual.name == name && std::find(names.begin(), names.end(), usual.option) != names.end())
    {
      return problem + "; did you mean " + usual.option + usual.example + "?";
    }
  }
  return problem + SuggestName(name, names);
}

} // end namespace medialvoxel
