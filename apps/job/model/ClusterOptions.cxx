// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterOptions.h"

#include "Text.h"

#include <string_view>

namespace medialvoxel
{
namespace
{

std::optional<std::uint64_t>
ParsePositive(std::string_view text)
{
  const std::optional<std::int64_t> number = ParseInteger(text);
  return number && *number > 0 ? std::optional<std::uint64_t>(*number) : std::nullopt;
}

} // namespace

bool
ParseSlurmClusters(const std::string & text, SlurmOptions & options)
{
  const std::size_t percent = text.find('%');
  options.clustersPerTask = ParsePositive(std::string_view(text).substr(0, percent));
  options.tasksAtOnce = percent == std::string::npos ? std::nullopt : ParsePositive(text.substr(percent + 1));
  return options.clustersPerTask && (percent == std::string::npos || options.tasksAtOnce);
}

} // end namespace medialvoxel
