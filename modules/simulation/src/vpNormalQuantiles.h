/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpNormalQuantiles.h
 * \brief Normal random numbers from 16 random bits, by table.
 */
#ifndef vpNormalQuantiles_h
#define vpNormalQuantiles_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <cstdint>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Quantiles of the normal distribution with variance 1 at (k + 1/2) / 65536: up to +-4.3, the variance of a
 * random entry is 1 within 1e-6.
 */
class vpNormalQuantiles
{
public:
  //! The table, made at its first use.
  static const vpNormalQuantiles &get();
  float operator[](std::uint16_t k) const { return m_table[k]; }

private:
  vpNormalQuantiles();
  std::vector<float> m_table;
};

END_VISP_NAMESPACE
#endif
