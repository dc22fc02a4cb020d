/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file runData.h
 * \brief An avoidance experiment as data: its log, its scene and its metrics.
 */
#ifndef vpApp_runData_h
#define vpApp_runData_h

#include "outputFolder.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vpApp
{
//! Speed and acceleration of a point at these positions, one period apart, from rest; m/s, m/s^2.
struct Rates {
  std::vector<double> speed, acceleration;
};
[[nodiscard]] Rates ratesOf(const std::vector<Eigen::Vector3d> &places, double period);

//! One row per period; schema.json in python/visp_direct/report has the columns.
[[nodiscard]] std::string samplesCsv(const vpAvoidanceRun &run);
//! Metrics by the names of vpAvoidanceMetrics.
[[nodiscard]] nlohmann::ordered_json metricsJson(const vpAvoidanceMetrics &metrics);
/*!
 * What was in the way: the ground, objects known from the start, and obstacles with their motion.
 * \param end : Until when, s. \param mesh : Beginning of the names of the files of meshes, "mesh/S4b-".
 * \throw std::runtime_error naming a file of a mesh that cannot be written.
 */
[[nodiscard]] nlohmann::ordered_json sceneData(OutputFolder &out, const vpAvoidanceRunSpec &spec, double end,
                                               const std::string &mesh);

//! One row of a CSV file, cell by cell. Numbers have 7 digits; what is not finite is left empty; text is quoted.
class CsvRow
{
public:
  CsvRow &operator<<(double value);
  CsvRow &operator<<(const Eigen::Vector3d &p) { return *this << p.x() << p.y() << p.z(); }
  CsvRow &operator<<(const vpJointVector &q);
  CsvRow &operator<<(bool value) { return add(value ? "1" : "0"); }
  CsvRow &operator<<(int value) { return add(std::to_string(value)); }
  CsvRow &operator<<(unsigned int value) { return add(std::to_string(value)); }
  CsvRow &operator<<(const char *word) { return add(word); } //!< As it is.
  CsvRow &operator<<(const std::string &text);
  //! The row with its line end.
  [[nodiscard]] std::string line() const { return m_text + "\n"; }

private:
  CsvRow &add(const std::string &cell);

  std::string m_text;
  bool m_begun = false;
};
} // namespace vpApp

#endif
