/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCameraFaultModel.h"

#include <visp3/core/vpGaussRand.h>
#include <visp3/core/vpImageFilter.h>
#include <visp3/core/vpUniRand.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr unsigned int poolSize = 1u << 16;
} // namespace

const vpFields<vpCameraFaults> &vpCameraFaults::fields()
{
  using Faults = vpCameraFaults;
  static const vpFields<Faults> all = {
      {"noise", &Faults::noise, vpFieldRange::notNegative(), "",
       "Standard deviation of the grey value, whose scale is 0 to 255"},
      {"blur", &Faults::blur, vpFieldRange::notNegative(5.), "px", "Standard deviation of a Gaussian blur"},
      {"gain", &Faults::gain, vpFieldRange::positive(), "", "Factor on the grey value"},
      {"bias", &Faults::bias, {}, "", "Offset added to the grey value"},
      {"occlusion", &Faults::occlusion, vpFieldRange::notNegative(0.9), "",
       "Fraction of the target's image area that a textured blob hides"},
  };
  return all;
}

void vpCameraFaults::validate() const { vpCheckFields(*this, fields(), "the camera's faults"); }

vpCameraFaultModel::vpCameraFaultModel() : m_pool(poolSize)
{
  vpGaussRand normal(1., 0., 1);
  std::generate(m_pool.begin(), m_pool.end(), [&normal]() { return static_cast<float>(normal()); });
}

void vpCameraFaultModel::apply(const vpCameraFaults &faults, unsigned int seed, vpImage<unsigned char> &image)
{
  const unsigned int width = image.getWidth(), height = image.getHeight();
  const bool blurred = faults.blur > 0.;
  if (blurred) {
    const unsigned int size = 2 * static_cast<unsigned int>(std::ceil(3. * faults.blur)) + 1;
    vpImageFilter::gaussianBlur(image, m_blurred, size, faults.blur);
  }
  else if (faults.gain == 1. && faults.bias == 0. && faults.noise == 0.) {
    return;
  }
  vpUniRand random(seed);
  const float gain = static_cast<float>(faults.gain), bias = static_cast<float>(faults.bias) + 0.5f;
  const float noise = static_cast<float>(faults.noise);
  for (unsigned int r = 0; r < height; ++r) {
    // A row takes a section of the pool from a random position on.
    unsigned int next = random.next();
    unsigned char *pixel = image[r];
    for (unsigned int c = 0; c < width; ++c, ++next) {
      const float value = blurred ? static_cast<float>(m_blurred[r][c]) : pixel[c];
      const float seen = gain * value + bias + noise * m_pool[next % poolSize];
      pixel[c] = static_cast<unsigned char>(std::clamp(seen, 0.f, 255.f));
    }
  }
}

END_VISP_NAMESPACE
