/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outcome.h
 * \brief What became of a design.
 */
#ifndef printExplore_outcome_h
#define printExplore_outcome_h

#include "cameraTiming.h"

namespace printExplore
{
//! \brief A design with its figures. Those of the closed loop are 0 unless it was simulated.
struct Outcome {
  Design design;
  Timing timing;
  Verdict verdict;
  double sensorX = 0.;      //!< Deviation of a cell along the motion, um.
  double sensorY = 0.;      //!< Across, um.
  double landingRms = 0.;   //!< Distance of the drops from the centres over all runs, um.
  double landing95 = 0.;    //!< 95 % are nearer, um.
  double landingWorst = 0.; //!< The largest, um.
  int cells = 0;            //!< That were to be printed in all runs.
  int missed = 0;           //!< Without a drop: passed over, or not reached in 1.25 times the time it should take.
  int doubled = 0;          //!< With more than one.
  double throughput = 0.;   //!< Cells a second, mean of the runs.
  bool thesis = false;      //!< The camera and velocity of the thesis.
  bool front = false;       //!< #required, and no such design is better in one objective and as good in all others.
  bool required = false;    //!< Keeps what is required, and works.
};

//! \brief A figure of an outcome that can be an objective or be required.
struct Figure {
  const char *name; //!< In files.
  const char *text; //!< For people, with its unit.
  bool more;        //!< More is better.
  double (*of)(const Outcome &);
};

//! All such figures.
[[nodiscard]] const std::vector<Figure> &figures();
//! That called so. \throw std::out_of_range if there is none.
[[nodiscard]] const Figure &figureCalled(const std::string &name);

/*!
 * Simulate a design: what the camera sees, then the closed loop with rendered pictures, once for each run.
 * \param design : Of the setup. \param index : Its number there; with the setup's seed it fixes everything random.
 * \param goOn : Asked now and then; false stops early, and the outcome is of no use.
 */
[[nodiscard]] Outcome evaluate(const Design &design, std::size_t index, const Setup &setup, bool (*goOn)());
} // namespace printExplore

#endif
