/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Measured cells of a frame: from the true state, or from rendered images.
#ifndef vpPrintCellSensor_h
#define vpPrintCellSensor_h

#include <visp3/pattern/vpPatternTracker.h>
#include "lab/printing/vpPrintExperiment.h"
#include <visp3/rendering/vpProductPattern.h>

#include <random>

BEGIN_VISP_NAMESPACE

class vpPrintCellSensor
{
public:
  vpPrintCellSensor(const vpPrintExperimentSpec &spec, const vpProductPattern &product);
  //! Measures the cells in frame number \e frame, with the product at (x, y) and its velocity (vx, vy).
  void see(double x, double y, double vx, double vy, unsigned int frame);
  [[nodiscard]] const std::vector<vpPatternCell> &cells() const { return m_cells; }
  [[nodiscard]] unsigned int epoch() const { return m_epoch; }
  [[nodiscard]] std::mt19937_64 &random() { return m_random; }

private:
  void seeModel(double x, double y);
  void seeImage(double x, double y, double vx, double vy, unsigned int frame);
  void number(double x, double y, const vpPatternFrame &frame);

  const vpPrintSensorModel m_model;
  const vpProductPattern &m_product;
  vpPatternTracker m_tracker;
  std::mt19937_64 m_random;
  std::normal_distribution<double> m_normal{0., 1.};
  std::vector<vpPatternCell> m_cells;
  vpImage<unsigned char> m_image;
  unsigned int m_epoch = 0;
  bool m_fromImages;
  bool m_numbered = false;
  int m_rowOffset = 0, m_columnOffset = 0; // product minus tracker
};

END_VISP_NAMESPACE
#endif
