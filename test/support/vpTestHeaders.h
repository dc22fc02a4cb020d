/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTestHeaders.h
 * \brief Precompiled header of the tests; not included explicitly.
 */
#ifndef vpTestHeaders_h
#define vpTestHeaders_h

#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpHomogeneousMatrix.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#endif
