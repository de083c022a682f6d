// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWarningRules_h
#define medialvoxelWarningRules_h

#include "Text.h"
#include "Warning.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** Message and values of a warning that applies. */
struct WarningText
{
  std::string                                 message;
  std::vector<std::pair<std::string, double>> values;
};

/** A share as a whole percentage, or as 0.5 % and the like. */
inline std::string
FormatShare(const double share)
{
  return FormatFixed(100.0 * share, share > 0.0 && share < 0.01 ? 1 : 0) + " %";
}

/** A row of a table: a code, and the check that finds whether it applies to the facts. */
template <typename... TFacts>
struct Rule
{
  const char * code;
  std::optional<WarningText> (*check)(const TFacts &...);
  bool isOfEvidence{ false }; ///< without evidence there is no verdict on walls
};

template <typename... TFacts>
void
Apply(const std::vector<Rule<TFacts...>> & rules, std::vector<Warning> & warnings, const TFacts &... facts)
{
  for (const Rule<TFacts...> & rule : rules)
  {
    if (std::optional<WarningText> text = rule.check(facts...))
    {
      warnings.push_back({ rule.code, std::move(text->message), std::move(text->values), rule.isOfEvidence });
    }
  }
}

template <typename... TFacts>
void
AddCodes(const std::vector<Rule<TFacts...>> & rules, std::vector<std::string> & codes)
{
  for (const Rule<TFacts...> & rule : rules)
  {
    codes.emplace_back(rule.code);
  }
}

} // end namespace medialvoxel

#endif
