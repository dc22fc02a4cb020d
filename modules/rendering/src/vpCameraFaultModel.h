/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCameraFaultModel.h
 * \brief Lens, exposure and sensor: converts an ideal image to a camera image.
 */
#ifndef vpCameraFaultModel_h
#define vpCameraFaultModel_h

#include <visp3/rendering/vpPlaneRenderer.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! Applies vpCameraFaults in the order of the light path: blur (lens), gain and bias (exposure), noise (sensor).
class vpCameraFaultModel
{
public:
  vpCameraFaultModel();
  //! \param seed : Seed of the noise. \param image : Modified in place.
  void apply(const vpCameraFaults &faults, unsigned int seed, vpImage<unsigned char> &image);

private:
  std::vector<float> m_pool; // standard normal numbers: drawing one per pixel would take longer than rendering
  vpImage<double> m_blurred;
};

END_VISP_NAMESPACE
#endif
