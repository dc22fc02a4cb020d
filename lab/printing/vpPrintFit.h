/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintFit.h
 * \brief Plant and gains of figures 7.12 to 7.15, fitted to all that the thesis says of them.
 */
#ifndef vpPrintFit_h
#define vpPrintFit_h

#include "lab/printing/vpPrintExperiment.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief The thesis gives neither friction nor gains of section 7.3.4. They are fitted: the numbers below are varied so
 * that the simulated figures have what the thesis states, each statement with its own scale.
 */
namespace vpPrintFit
{
//! \brief What the thesis leaves open.
struct Parameter {
  const char *name; //!< "viscous", for tables.
  const char *unit; //!< px, frames, mass 1.
  double low, high; //!< Range searched, on a logarithmic scale.
};
//! All of them, in the order of the vectors below.
[[nodiscard]] const std::vector<Parameter> &parameters();

//! \brief Which controller figure 7.15 has: the thesis says only that the filter is poor.
enum class PoorFilter {
  Pid,        //!< That of figure 7.13, without feedforward.
  Feedforward //!< That of figure 7.14.
};

//! \brief The experiments of the figures.
struct Figures {
  vpPrintExperimentSpec step;        //!< Figure 7.12: velocity step to 4 px/frame, 480 frames.
  vpPrintExperimentSpec pid;         //!< Figure 7.13.
  vpPrintExperimentSpec feedforward; //!< Figure 7.14.
  vpPrintExperimentSpec poor;        //!< Figure 7.15.
};
//! The experiments with these values. \param values : As many as parameters().
[[nodiscard]] Figures figuresOf(const Eigen::VectorXd &values, PoorFilter poor);

//! \brief A statement of the thesis and the simulated value.
struct Statement {
  std::string name; //!< "rms velocity error, figure 7.13".
  std::string unit; //!< px/frame.
  double thesis;    //!< Value or bound.
  double ours;      //!< Simulated.
  double scale;     //!< A difference that counts as 1, in the unit.
  double residual;  //!< (ours - thesis) / scale; 0 on the good side of a bound.
};
/*!
 * Runs the experiments and compares.
 * \param seeds : Number of seeds, > 0. \param first : The first of them. \param stepSeeds : Of figure 7.12; 0: as many.
 */
[[nodiscard]] std::vector<Statement> statementsOf(const Figures &figures, int seeds, unsigned int first = 1,
                                                  int stepSeeds = 0);
//! Sum of the squared residuals.
[[nodiscard]] double costOf(const std::vector<Statement> &statements);

//! The values found, see data/thesis/print-fit.csv.
[[nodiscard]] Eigen::VectorXd stored();
//! The reading of figure 7.15 that they are for.
constexpr PoorFilter storedPoor = PoorFilter::Pid;

//! \brief Result of the search.
struct Result {
  Eigen::VectorXd values; //!< As many as parameters().
  double cost = 0.;       //!< costOf() with the seeds of the search.
  int evaluations = 0;    //!< Of the whole set of experiments.
};
/*!
 * Search from the middle of the ranges by vpCovarianceSearch.
 * \param poor : Reading of figure 7.15. \param generations : Most generations. \param seeds : Seeds of each experiment.
 * \param seed : Of the search. \param progress : Called with generation and cost; false ends it.
 */
[[nodiscard]] Result search(PoorFilter poor, int generations, int seeds, unsigned int seed,
                            const std::function<bool(int, double)> &progress = {});
//! Table of values and statements, as in data/thesis/print-fit.csv.
[[nodiscard]] std::string csvOf(const Eigen::VectorXd &values, PoorFilter poor, int seeds);
} // namespace vpPrintFit

END_VISP_NAMESPACE
#endif
