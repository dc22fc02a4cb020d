/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPolynomial.h
 * \brief Polynomial of bounded degree on [0, 1]: values, derivatives, real roots and exact extrema, all in place.
 */
#ifndef vpPolynomial_h
#define vpPolynomial_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <initializer_list>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpPolynomial
 * \ingroup group_trajectory
 * \brief c0 + c1 s + ... + cn s^n with n <= 14, stored in place, studied on 0 <= s <= 1.
 *
 * Motions are polynomials in the normalised time s = t/T: in t the Vandermonde matrix of the thesis's (3.61) has
 * condition 2e16 at T = 1 ms, in s the coefficients are closed forms of the order of the motion itself.
 * The capacity holds a path of degree 8 and the square of its derivative (for limits on a Euclidean norm).
 * Nothing here allocates or throws.
 *
 * \code
 * vpPolynomial p{0., 0., 0., 10., -15., 6.}; // minimum jerk: 10 s^3 - 15 s^4 + 6 s^5
 * const vpPolynomial::Range speed = p.derivative().range();
 * std::cout << "fastest at " << speed.atMax << ": " << speed.max << std::endl; // 0.5: 1.875
 * p[0] -= 0.1;
 * for (const double s : p.roots()) {
 *   std::cout << "a tenth of the way at " << s << std::endl; // 0.247
 * }
 * \endcode
 */
class VISP_EXPORT vpPolynomial
{
public:
  //! Largest degree that fits.
  static constexpr int maxDegree = 14;

  //! Points of [0, 1] in ascending order.
  struct Points {
    std::array<double, maxDegree> s{};                                   //!< The points; the first #count are valid.
    int count = 0;                                                       //!< Number of points.
    [[nodiscard]] const double *begin() const { return s.data(); }       //!< First point.
    [[nodiscard]] const double *end() const { return s.data() + count; } //!< One past the last point.
  };

  //! Smallest and largest value on an interval and their locations.
  struct Range {
    double min = 0.;   //!< Smallest value.
    double max = 0.;   //!< Largest value.
    double atMin = 0.; //!< Location of the smallest value.
    double atMax = 0.; //!< Location of the largest value.
    //! Largest absolute value.
    [[nodiscard]] double peak() const { return max > -min ? max : -min; }
  };

  //! The zero polynomial.
  vpPolynomial() = default;
  //! From coefficients, constant first, at most maxDegree + 1 of them; more are ignored.
  vpPolynomial(std::initializer_list<double> coefficients);

  //! Degree as stored: the highest coefficient may be zero.
  [[nodiscard]] int degree() const { return m_degree; }
  //! Change the degree, clamped to 0 ... maxDegree; new coefficients are zero.
  void setDegree(int degree);
  //! Coefficient of s^k, 0 <= k <= degree().
  [[nodiscard]] double operator[](int k) const { return m_c[static_cast<std::size_t>(k)]; }
  //! Coefficient of s^k, writable.
  [[nodiscard]] double &operator[](int k) { return m_c[static_cast<std::size_t>(k)]; }
  //! Coefficients, constant first.
  [[nodiscard]] const double *data() const { return m_c.data(); }

  //! Value at \e s (Horner), any \e s.
  [[nodiscard]] double value(double s) const noexcept;
  //! Value, first, second and third derivative at \e s.
  [[nodiscard]] std::array<double, 4> jet(double s) const noexcept;
  //! The derivative d/ds.
  [[nodiscard]] vpPolynomial derivative() const noexcept;
  //! The product of two polynomials; the sum of their degrees must be at most maxDegree (higher terms are dropped).
  [[nodiscard]] vpPolynomial times(const vpPolynomial &other) const noexcept;
  //! p(offset + scale u) as a polynomial in u: a part of the curve, reparameterised.
  [[nodiscard]] vpPolynomial composed(double offset, double scale) const noexcept;

  /*!
   * All real roots in [0, 1], each once, in ascending order.
   *
   * Closed forms up to the quadratic; above, the roots of the derivative split [0, 1] into monotone pieces and each
   * sign change is refined by Newton steps kept inside the bracket. A double root is reported when the value at the
   * extremum is zero to rounding. The zero polynomial has no roots here.
   */
  [[nodiscard]] Points roots() const noexcept;

  //! Exact smallest and largest value for from <= s <= to, 0 <= from <= to <= 1, from the roots of the derivative.
  [[nodiscard]] Range range(double from = 0., double to = 1.) const noexcept;

private:
  std::array<double, maxDegree + 1> m_c{};
  int m_degree = 0;
};

END_VISP_NAMESPACE
#endif
