/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file patternRun.h
 * \brief vpPatternTracker on rendered products: errors of the centres, and time.
 */
#ifndef thesisReport_patternRun_h
#define thesisReport_patternRun_h

#include "spread.h"

#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/rendering/vpProductPattern.h>

#include <functional>
#include <vector>

namespace thesisReport
{
VISP_DIRECT_USING_NAMESPACE

//! The display of the thesis under its camera: the default product with noise 4, which was chosen so that Algorithm 7.4
//! has the thesis's deviation.
[[nodiscard]] vpProductPatternSpec thesisProduct(unsigned int seed);

//! \brief Centres against the truth of the renderer.
struct CentreErrors {
  Spread x, y;           //!< px.
  std::size_t whole = 0; //!< Cells that lie completely in view.
  std::size_t most = 0;  //!< The most of them in one image.
  std::size_t found = 0; //!< Those with a valid centre within 2 px.
  [[nodiscard]] double share() const { return static_cast<double>(found) / static_cast<double>(whole); }
};

/*!
 * Move a product under the tracker, about 4 px/frame along the rows, and compare. Images count from the first with a
 * learned template on where the method has one.
 * \param images : How many. \param product : Rendered. \param progress : Called with the share done.
 */
[[nodiscard]] CentreErrors centreErrors(const vpProductPattern &product, const vpPatternOptions &options, int images,
                                        const std::function<void(double)> &progress);

//! Images of a product that swings by \e amplitude px and comes back to where it began, to be gone round and round.
[[nodiscard]] std::vector<vpImage<unsigned char>> roundTrip(const vpProductPatternSpec &spec, double amplitude);

//! \brief How long an image takes.
struct TrackingTime {
  Spread us;          //!< Of each image, us, see coreSeconds().
  double locked = 0.; //!< Share of the images with status Tracking; baselines without a template too.
  double cells = 0.;  //!< Valid cells of an image, mean.
  double pitchX = 0.; //!< Distance of neighbouring cells along the row, from the tracker's lattice, px.
  //! The highest rate at which 99 of 100 images are done before the next one comes, Hz.
  [[nodiscard]] double sustainedRate() const { return 1e6 / us.quantile(0.99); }
};

//! Time of vpPatternTracker::track() alone, once the template is learned.
[[nodiscard]] TrackingTime timeTracking(const std::vector<vpImage<unsigned char>> &images,
                                        const vpPatternOptions &options, std::size_t least);
} // namespace thesisReport

#endif
