/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCovarianceSearch.h
 * \brief Least value of a function of a few dozen bounded numbers, without derivatives.
 */
#ifndef vpCovarianceSearch_h
#define vpCovarianceSearch_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <functional>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Covariance matrix adaptation (N. Hansen, The CMA evolution strategy: a tutorial, 2016), in the unit cube.
 *
 * Points outside the cube are evaluated at the nearest point inside, plus the squared distance times #outside.
 */
struct vpCovarianceSearch {
  int generations = 200;      //!< Most generations, >= 1.
  int population = 0;         //!< Points a generation; 0: 4 + 3 ln n.
  double step = 0.2;          //!< First standard deviation, > 0.
  double smallestStep = 1e-5; //!< Ends when the standard deviation is below.
  double outside = 1e3;       //!< Weight of the squared distance from the cube.
  unsigned int seed = 1;      //!< Seed of the sampling.

  //! \brief What was found.
  struct Result {
    Eigen::VectorXd x;   //!< The best point, inside the cube.
    double value = 0.;   //!< The function there.
    int evaluations = 0; //!< Calls of the function.
    double step = 0.;    //!< Last standard deviation.
  };
  /*!
   * \param start : First mean, in the cube. \param f : The function; NaN counts as infinite.
   * \param progress : Called after each generation with its number and the best value so far; false ends the search.
   * \throw vpException (badValue) naming a setting or a number of the start that is out of range.
   */
  [[nodiscard]] Result run(const Eigen::VectorXd &start, const std::function<double(const Eigen::VectorXd &)> &f,
                           const std::function<bool(int, double)> &progress = {}) const;
};

END_VISP_NAMESPACE
#endif
