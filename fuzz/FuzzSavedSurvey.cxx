// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The part of the statistics that a cluster leaves, unpacked: packed here, as zlib's checksum lets no change through.

#include "FuzzSupport.h"

#include "Errors.h"
#include "Survey.h"

#include "itk_zlib.h"

namespace
{

using namespace MedialVoxelFuzz;
using namespace medialvoxel;

Survey
MakeSurvey()
{
  VolumeGeometry geometry;
  geometry.size = { 5, 4, 3 };
  geometry.spacing = { 1, 1, 1 };
  geometry.origin = { 0, 0, 0 };
  geometry.SetIdentityDirection();
  SurveySettings settings;
  settings.picture = true;
  return { geometry, itk::MedialVoxelGrid({ { 5, 4, 3 } }, { { 1, 1, 1 } }), settings };
}

/** The number of bytes, eight of them, low ones first, and the packed bytes. */
std::string
Pack(const std::uint8_t * data, std::size_t size)
{
  uLongf      length = compressBound(size);
  std::string packed(8 + length, '\0');
  for (unsigned int i = 0; i < 8; ++i)
  {
    packed[i] = static_cast<char>(std::uint64_t{ size } >> (8 * i));
  }
  compress2(reinterpret_cast<Bytef *>(&packed[8]), &length, data, size, Z_BEST_SPEED);
  packed.resize(8 + length);
  return packed;
}

/** False for a part that is refused. */
bool
Merge(Survey & survey, const std::string & part)
try
{
  survey.Merge(part);
  return true;
}
catch (const JobError & error)
{
  Require(error.GetStatus() == ExitStatus::Failure, "an unexpected status");
  return false;
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  Survey survey = MakeSurvey();
  Merge(survey, { reinterpret_cast<const char *>(data), size });
  if (Merge(survey, Pack(data, size)))
  {
    Survey again = MakeSurvey();
    Require(Merge(again, survey.Save()) && again.Save() == survey.Save(), "another survey after saving it");
  }
  return 0;
}
