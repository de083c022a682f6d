// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelExtractParts_h
#define medialvoxelExtractParts_h

#include "Surveys.h"
#include "JobResult.h"
#include "Options.h"

namespace medialvoxel
{

/** Checks everything that an extraction needs and plans it, before anything is written.
 * \throw JobError */
JobResult
PrepareExtract(const ExtractOptions & options);

/** The same for processes that share the outputs, with the memory that each of them takes.
 * \throw JobError */
JobResult
PrepareProcesses(const ExtractOptions & options);

/** The part of such a process, without the outputs, which exist already and are being written: header, plan for this
 * machine, threads.
 * \throw JobError */
JobResult
PrepareSharedExtract(const ExtractOptions & options);

/** The memory that the objects of a label map take to be extracted, without outputs beside their labels.
 * \throw JobError Refused when nothing fits */
JobPlan
PlanObjects(const ExtractOptions & options, const VolumeHeader & header);

/** The header of the input, and the outputs that are asked for. */
JobResult
DescribeExtract(const ExtractOptions & options);

/** What the outputs need to know about the medial cells. */
SurveyRequest
GetSurveyRequest(const ExtractOptions & options);

/** What each of those that keep something until a piece is done may take of the surplus of a plan. */
std::uint64_t
GetSurplusShare(const ExtractOptions & options, const JobPlan & plan);

/** Each cell must have been decided once. \throw JobError Failure */
void
CheckCounts(const itk::MedialVoxelCounts & counts);

} // end namespace medialvoxel

#endif
