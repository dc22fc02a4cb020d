/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outcome.h
 * \brief Evaluation of a design: accuracy of its camera, then the closed loop.
 */
#ifndef printExplore_outcome_h
#define printExplore_outcome_h

#include "machine.h"

namespace printExplore
{
//! \brief Errors of a sensor, px.
struct SensorTest {
  vpPrintSensorModel model; //!< Standard deviations of a cell, and number of independent cells; for the estimators.
  double held = 0.;         //!< Fraction of frames in which the tracker had cells, 0..1.
  double cells = 0.;        //!< Measured cells per frame.
  //! True if the tracker hardly ever lost the product, and measured enough cells to estimate its errors.
  [[nodiscard]] bool good() const { return held >= 0.95 && cells >= 1.; }
};

/*!
 * Accuracy of a camera for the cells: rendered images through vpPatternTracker, against the ground truth.
 * The tracker learns the product at slow motion, as in the print experiment, then sees it at the drop velocity.
 * \param product : Product seen by the camera. \param velocity : px/frame.
 */
[[nodiscard]] SensorTest testSensor(const vpProductPatternSpec &product, double velocity);

//! \brief A design with its metrics. Closed-loop metrics are 0 unless it was simulated.
struct Outcome {
  Design design;
  Timing timing;
  Verdict verdict;
  double sensorX = 0.;      //!< Standard deviation of a cell along the motion, um.
  double sensorY = 0.;      //!< Standard deviation of a cell across the motion, um.
  double landingRms = 0.;   //!< Rms distance of the drops from the centres over all runs, um.
  double landing95 = 0.;    //!< 95th percentile of the distance, um.
  double landingWorst = 0.; //!< Largest distance, um.
  int cells = 0;            //!< Cells to be printed in all runs.
  int missed = 0;           //!< Cells without a drop: skipped, or not reached within 1.25 times the expected time.
  int doubled = 0;          //!< Cells with more than one drop.
  double throughput = 0.;   //!< Cells per second, mean of the runs.
  bool thesis = false;      //!< The camera and velocity of the thesis.
  bool front = false;       //!< #required, and no such design is better in one objective and as good in all others.
  bool required = false;    //!< Feasible, and meets the requirements.

  //! Sets what follows from the design alone.
  void describe(const Design &which, const Setup &setup);
};
//! What does not, see sweep.h.
template <class Archive> void exchange(Archive &archive, Outcome &o)
{
  archive(o.sensorX, o.sensorY, o.landingRms, o.landing95, o.landingWorst, o.throughput, o.cells, o.missed, o.doubled,
          o.verdict.kind, o.verdict.sentence);
}

//! \brief A metric of an outcome, usable as objective or requirement.
struct Figure {
  const char *name; //!< Name in files.
  const char *text; //!< Readable name, with unit.
  bool more;        //!< More is better.
  double (*of)(const Outcome &);
};

//! All metrics.
[[nodiscard]] const std::vector<Figure> &figures();
//! Metric of that name. \throw std::out_of_range if there is none.
[[nodiscard]] const Figure &figureCalled(const std::string &name);

/*!
 * Simulate a design: camera test, then the closed loop with rendered images, once per run.
 * \param design : Design of the setup. \param index : Its index; with the setup's seed it determines all random
 * numbers.
 * \param goOn : Polled; false stops early with an invalid outcome.
 */
[[nodiscard]] Outcome evaluate(const Design &design, std::size_t index, const Setup &setup, bool (*goOn)());
} // namespace printExplore

#endif
