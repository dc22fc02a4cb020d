/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionKalmanFilter.h
 * \brief Position, velocity and acceleration of one axis from readings that come late, out of order, or not at all.
 */
#ifndef vpMotionKalmanFilter_h
#define vpMotionKalmanFilter_h

#include <visp3/printing/vpMotionReadingResult.h>

#include <Eigen/Core>

#include <array>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief What is taken to be random about the motion.
enum class vpMotionModel {
  ConstantVelocity,    //!< The acceleration is white noise; states are position and velocity.
  ConstantAcceleration //!< The jerk is white noise; position, velocity and acceleration.
};

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpMotionKalmanFilter, in a length L (px) and a time T (frame).
 */
struct VISP_EXPORT vpMotionKalmanSpec {
  vpMotionModel model = vpMotionModel::ConstantAcceleration; //!< Which motion.
  //! Spectral density of the white noise: L^2/T^3 of the acceleration, L^2/T^5 of the jerk; > 0.
  double processNoise = 1e-3;
  double sigmaPosition = 1e3;    //!< Standard deviation at the start, L, > 0.
  double sigmaVelocity = 10.;    //!< Of the velocity at the start, L/T, > 0.
  double sigmaAcceleration = 1.; //!< Of the acceleration at the start, L/T^2, > 0.
  double gate = 6.;     //!< Readings off by more than so many standard deviations are not used; > 0, may be infinite.
  double maxDelay = 4.; //!< Readings may come in any order within this time, T, >= 0.
  double encoderScaleSigma = 0.;  //!< Encoder: p (1 + scale) + offset; of the scale at the start, >= 0. 0: known.
  double encoderOffsetSigma = 0.; //!< Of the offset at the start, L, >= 0. 0: known.
  //! Slip of the encoder: its offset walks at random with this density, L^2/T, >= 0.
  double encoderSlip = 0.;
  double maxGap =
      1e5; //!< Readings farther ahead of the newest one are refused, and nobody extrapolates farther, T, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief Kind of a vpMotionReading.
enum class vpMotionReadingKind {
  Position,     //!< Position itself, such as a cell whose identity is known.
  Displacement, //!< Since the time of the last Displacement or Mark, such as vpPatternFrame::dx.
  Mark,         //!< No value: displacements count from here (a frame without a motion).
  Encoder       //!< p (1 + scale) + offset.
};

//! \ingroup group_printing
//! \brief One measurement.
struct VISP_EXPORT vpMotionReading {
  vpMotionReadingKind kind = vpMotionReadingKind::Position; //!< What was measured.
  double time = 0.;                                         //!< When it was so (not when it came), T.
  double value = 0.;                                        //!< L.
  double sigma = 1.;                                        //!< Its standard deviation, L, > 0.
};

//! \ingroup group_printing
//! \brief State of the motion at an instant.
struct VISP_EXPORT vpMotionEstimate {
  bool asAsked = true;           //!< False: the time asked for is out of reach; #time tells which state this is.
  double time = 0.;              //!< T.
  double position = 0.;          //!< L.
  double velocity = 0.;          //!< L/T.
  double acceleration = 0.;      //!< L/T^2; 0 with ConstantVelocity.
  double sigmaPosition = 0.;     //!< L.
  double sigmaVelocity = 0.;     //!< L/T.
  double sigmaAcceleration = 0.; //!< L/T^2.
  double encoderScale = 0.;      //!< Without unit.
  double encoderOffset = 0.;     //!< L.
  double sigmaScale = 0.;        //!< Of encoderScale.
  double sigmaOffset = 0.;       //!< Of encoderOffset, L.
  //! Covariance of position, velocity and acceleration.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/*!
 * \class vpMotionKalmanFilter
 * \ingroup group_printing
 * \brief Kalman filter of one axis, exact for late and unordered readings, with an optional encoder.
 *
 * Readings carry the time at which they were true. Those within maxDelay of the newest are kept in order of time and
 * replayed, so the answer is that of a filter that got them in order; older ones are settled. A reading that is missing
 * is simply not given. The displacement since the last one is a state of its own, which keeps the correlation. Two axes are two filters.
 *
 * Displacement errors are taken to be independent. Those of successive frames are not quite (the same error of the middle
 * frame is in both, with opposite signs); Position readings of identified cells are better where there are any.
 *
 * The standard deviations are those of the spec and of the readings, carried along: they hold as far as these do. The gate
 * keeps out what contradicts them; it is no test of the fit.
 *
 * The third reading of a kind in a row beyond the gate is taken to be right and the belief to be wrong (for an encoder: it has
 * slipped).
 *
 * A reading more than maxGap ahead is refused, for one broken time stamp would make all that follow come too late. After a
 * longer gap, or when the clock was set anew, reset() to the present. The filter starts at time 0: reset() first when the
 * clock does not.
 *
 * add() and at() do not allocate, throw, lock or print.
 */
class VISP_EXPORT vpMotionKalmanFilter
{
public:
  static constexpr int capacity = 32; //!< Readings kept for replay at most; the oldest are settled earlier if need be.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  explicit vpMotionKalmanFilter(const vpMotionKalmanSpec &spec = vpMotionKalmanSpec());

  //! Take a reading.
  vpMotionReadingResult add(const vpMotionReading &reading) noexcept;
  /*!
   * The motion at any time, with all readings that have come. Before the oldest settled time: the state there; more than
   * maxGap behind the newest: the state that far ahead; of NaN: the newest.
   */
  [[nodiscard]] vpMotionEstimate at(double time) const noexcept;
  /*!
   * Start anew at a known state, uncertain as the specification says.
   * \param time, position, velocity : T, L, L/T. Numbers that are not finite or beyond vpPrintingLargest change nothing.
   */
  void reset(double time, double position = 0., double velocity = 0.) noexcept;
  //! Readings that the gate has refused since reset().
  [[nodiscard]] int outliers() const { return m_outliers; }
  //! As given.
  [[nodiscard]] const vpMotionKalmanSpec &spec() const { return m_spec; }

private:
  static constexpr int states =
      6; // position, velocity, acceleration, displacement since the mark, encoder offset, scale
  using Vector = Eigen::Matrix<double, states, 1>;
  using Matrix = Eigen::Matrix<double, states, states>;
  //! \brief Belief at a time.
  struct Belief {
    double time = 0.;
    Vector x = Vector::Zero();
    Matrix P = Matrix::Zero();
    bool marked = false;
    std::array<int, 4> refused{}; // readings of each kind beyond the gate in a row
  };
  void predict(Belief &belief, double time) const noexcept;
  vpMotionReadingResult correct(Belief &belief, const vpMotionReading &reading) const noexcept;
  static void mark(Belief &belief) noexcept;
  static void clearMoved(Belief &belief) noexcept;
  [[nodiscard]] static bool isSound(const Belief &belief) noexcept;
  [[nodiscard]] vpMotionReadingResult resultOf(Belief &belief, const vpMotionReading &reading) const noexcept;
  void settleOldest() noexcept;

  vpMotionKalmanSpec m_spec;
  Belief m_settled;                                // with all readings that can no longer be preceded
  Belief m_newest;                                 // with all readings
  std::array<vpMotionReading, capacity> m_pending; // in order of time
  int m_count = 0;
  int m_outliers = 0;
};

END_VISP_NAMESPACE
#endif
