/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRootKernel.h
 * \brief Root finding on raw coefficients, shared by vpPolynomial and the search for the smallest duration.
 */
#ifndef vpRootKernel_h
#define vpRootKernel_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

namespace vpRootKernel
{
//! Value of the polynomial of this degree.
[[nodiscard]] inline double horner(const double *c, int degree, double s)
{
  double value = c[degree];
  for (int k = degree - 1; k >= 0; --k) {
    value = value * s + c[k];
  }
  return value;
}

//! Derivative coefficients; \e out has capacity for \e degree numbers.
inline void differentiate(const double *c, int degree, double *out)
{
  for (int k = 1; k <= degree; ++k) {
    out[k - 1] = k * c[k];
  }
}

//! Roots of a polynomial of degree <= 2 in [0, 1], ascending; returns their number.
int closedFormRoots(const double *c, int degree, double *out) noexcept;

//! What rootsBetween() computes.
enum class Wanted {
  Roots,  //!< All roots to the last digit, also where the polynomial touches zero.
  Extrema //!< Roots for extrema of the next lower derivative: sign changes only, to 1e-9, whose square matters.
};

/*!
 * Roots in [0, 1] of a polynomial whose derivative has the roots \e critical there; returns their number.
 */
int rootsBetween(const double *c, int degree, const double *critical, int criticalCount, Wanted wanted,
                 double *out) noexcept;

//! Bounds of the polynomial on [0, 1]: the extremes of its Bernstein coefficients, which enclose it. Degree <= 8.
void enclose(const double *c, int degree, double &low, double &high) noexcept;

//! Whether the polynomial stays between these values on [0, 1]: by halves until enclose() or a value decides, else by the
//! roots of its derivative. Degree <= 8.
bool staysWithin(const double *c, int degree, double low, double high) noexcept;

//! Smallest and largest value on [from, 1], within [0, 1]; its places to 1e-7, so the values to 1e-13. Degree <= 8.
void extremes(const double *c, int degree, double from, double &low, double &high) noexcept;

//! True when |polynomial| <= bound on [0, 1] is certain from enclose(). False says nothing.
bool isSurelyWithin(const double *c, int degree, double bound) noexcept;

//! All roots in [0, 1], touching ones included unless Extrema are wanted; \e out has room for \e degree numbers.
int allRoots(const double *c, int degree, double *out, Wanted wanted = Wanted::Roots) noexcept;

/*!
 * Smallest x > 0 with g(x) = 0, where g(0) = c[0] > 0; infinity if there is none. Closed form up to degree 2.
 */
double firstPositiveRoot(const double *c, int degree) noexcept;
} // namespace vpRootKernel

END_VISP_NAMESPACE
#endif
