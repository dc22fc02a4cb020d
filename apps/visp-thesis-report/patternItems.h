/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file patternItems.h
 * \brief Items of patternParts(), and the runs of vpPatternTracker on rendered products: errors of the centres, and time.
 */
#ifndef thesisReport_patternItems_h
#define thesisReport_patternItems_h

#include "part.h"

#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/rendering/vpProductPattern.h>

#include <functional>
#include <vector>

namespace thesisReport
{
VISP_DIRECT_USING_NAMESPACE

[[nodiscard]] std::vector<Item> frameRates(const Setting &setting);   //!< Figure 7.1, (7.2).
[[nodiscard]] std::vector<Item> dropDelay(const Setting &setting);    //!< Figure 7.3.
[[nodiscard]] std::vector<Item> trackability(const Setting &setting); //!< (7.1).
[[nodiscard]] std::vector<Item> thresholds(const Setting &setting);   //!< Table 7.1.
[[nodiscard]] std::vector<Item> derivatives(const Setting &setting);  //!< Table 7.2.
[[nodiscard]] std::vector<Item> visionTiming(const Setting &setting); //!< Table 7.3.
[[nodiscard]] std::vector<Item> distortion(const Setting &setting);   //!< Figure 7.10.
[[nodiscard]] std::vector<Item> calibrations(const Setting &setting); //!< Table 7.4.
[[nodiscard]] std::vector<Item> detection(const Setting &setting);    //!< Figure 7.11.

//! The display of the thesis under its camera: the default product with noise 4, chosen so that Algorithm 7.4 has the
//! thesis's standard deviation.
[[nodiscard]] vpProductPatternSpec thesisProduct(unsigned int seed);

//! \brief Errors of the centres against the renderer's ground truth.
struct CentreErrors {
  Spread x, y;           //!< px.
  std::size_t whole = 0; //!< Cells completely in view.
  std::size_t most = 0;  //!< Maximum of these in one image.
  std::size_t found = 0; //!< Cells with a valid centre within 2 px.
  [[nodiscard]] double share() const { return static_cast<double>(found) / static_cast<double>(whole); }
};

/*!
 * Move a product under the tracker, about 4 px/frame along the rows, and compare. If the method learns a template,
 * images count from the first with a learned template.
 * \param images : Number of images. \param product : Rendered product. \param progress : Called with the fraction done.
 */
[[nodiscard]] CentreErrors centreErrors(const vpProductPattern &product, const vpPatternTrackerSpec &options,
                                        int images, const std::function<void(double)> &progress);

//! Image loop of a product that oscillates with \e amplitude px and returns to its start.
[[nodiscard]] std::vector<vpImage<unsigned char>> roundTrip(const vpProductPatternSpec &spec, double amplitude);

//! \brief Tracking time per image.
struct TrackingTime {
  Spread us;          //!< Time of each image, us, see coreSeconds().
  double locked = 0.; //!< Fraction of images with status Tracking, also for baselines without a template.
  double cells = 0.;  //!< Mean number of valid cells per image.
  double pitchX = 0.; //!< Distance of neighbouring cells along the row, from the tracker's lattice, px.
  //! Highest rate at which 99 of 100 images are finished before the next one arrives, Hz.
  [[nodiscard]] double sustainedRate() const { return 1e6 / us.quantile(0.99); }
};

//! Time of vpPatternTracker::process() alone, once the template is learned.
[[nodiscard]] TrackingTime timeTracking(const std::vector<vpImage<unsigned char>> &images,
                                        const vpPatternTrackerSpec &options, std::size_t least);
} // namespace thesisReport

#endif
