/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFieldRows.h
 * \brief The rows that a page must have about the fields of a specification.
 */
#ifndef vpFieldRows_h
#define vpFieldRows_h

#include <visp3/direct_core/vpField.h>

#include <cstdio>

VISP_DIRECT_USING_NAMESPACE

namespace vpTestSupport
{
/*!
 * Rows `| prefix.name | description, unit | range | default |` that \e page lacks, to be copied into it; empty if none.
 * \param withUnits : True: names carry units, "lag_s".
 */
template <class Spec>
std::string missingRows(const std::string &page, const std::string &prefix, const vpFields<Spec> &fields,
                        const Spec &defaults, bool withUnits)
{
  std::string missing;
  for (const vpField<Spec> &field : fields) {
    char value[32];
    std::snprintf(value, sizeof value, "%.6g", field.of(defaults));
    const std::string unit = field.unit, name = vpFieldFileName(field.name, withUnits ? unit : "");
    const std::string row = "| `" + prefix + name + "` | " + field.description + (unit.empty() ? "" : ", " + unit) +
                            " | " + field.range.text() + " | " + value + " |\n";
    if (page.find(row) == std::string::npos) {
      missing += row;
    }
  }
  return missing;
}
} // namespace vpTestSupport

#endif
