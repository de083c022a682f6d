// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWarning_h
#define medialvoxelWarning_h

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** Something a user must know before a result is used. The job goes on; without evidence there is no verdict on
 * walls. */
struct Warning
{
  std::string                                 code;    ///< for scripts: small letters, words joined by underscores
  std::string                                 message; ///< for readers: one line without a period at its end
  std::vector<std::pair<std::string, double>> values;  ///< the numbers of the message by their names, all finite
  bool                                        isOfEvidence{ false }; ///< too little was measured for a verdict on walls
};

/** Codes of the warnings of headers. reports/Warnings.cxx and ObjectWarnings.cxx have the codes of requests and
 * results. */
namespace HeaderWarnings
{
constexpr const char * ContradictingForms = "contradicting_forms";
constexpr const char * DataBehindVoxels = "data_behind_voxels";
constexpr const char * SingleSlice = "single_slice";
constexpr const char * StoredValues = "stored_values";
constexpr const char * UnevenSlices = "uneven_slices";
constexpr const char * UnknownSliceOrder = "unknown_slice_order";
constexpr const char * UnknownSpacing = "unknown_spacing";

constexpr std::array<const char *, 7> All{ ContradictingForms, DataBehindVoxels,  SingleSlice,   StoredValues,
                                           UnevenSlices,       UnknownSliceOrder, UnknownSpacing };
} // namespace HeaderWarnings

} // end namespace medialvoxel

#endif
