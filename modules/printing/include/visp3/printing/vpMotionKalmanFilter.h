/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionKalmanFilter.h
 * \brief Position, velocity and acceleration of one axis from readings that are late, out of order, or missing.
 */
#ifndef vpMotionKalmanFilter_h
#define vpMotionKalmanFilter_h

#include <visp3/printing/vpMotionReadingResult.h>

#include <Eigen/Core>

#include <array>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief Motion model: which derivative is white noise.
enum class vpMotionModel {
  ConstantVelocity,    //!< The acceleration is white noise; states are position and velocity.
  ConstantAcceleration //!< The jerk is white noise; position, velocity and acceleration.
};

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpMotionKalmanFilter, in a length L (px) and a time T (frame).
 */
struct VISP_EXPORT vpMotionKalmanSpec {
  vpMotionModel model = vpMotionModel::ConstantAcceleration; //!< Motion model.
  //! Spectral density of the white noise: L^2/T^3 of the acceleration, L^2/T^5 of the jerk; > 0.
  double processNoise = 1e-3;
  double sigmaPosition = 1e3;    //!< Initial standard deviation of the position, L, > 0.
  double sigmaVelocity = 10.;    //!< Initial standard deviation of the velocity, L/T, > 0.
  double sigmaAcceleration = 1.; //!< Initial standard deviation of the acceleration, L/T^2, > 0.
  double gate = 6.;     //!< Readings off by more standard deviations than this are rejected; > 0, may be infinite.
  double maxDelay = 4.; //!< Readings may come in any order within this time, T, >= 0.
  double encoderScaleSigma = 0.;  //!< Encoder: p (1 + scale) + offset; initial sigma of the scale, >= 0. 0: known.
  double encoderOffsetSigma = 0.; //!< Initial sigma of the encoder offset, L, >= 0. 0: known.
  //! Slip of the encoder: random-walk density of its offset, L^2/T, >= 0.
  double encoderSlip = 0.;
  double maxGap = 1e5; //!< Maximum lead of a reading, and of an extrapolation, over the newest reading, T, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief Kind of a vpMotionReading.
enum class vpMotionReadingKind {
  Position,     //!< Position itself, such as a cell with known identity.
  Displacement, //!< Displacement since the last Displacement or Mark, such as vpPatternFrame::dx.
  Mark,         //!< No value: start of the next displacement (a frame without a motion).
  Encoder       //!< Encoder value p (1 + scale) + offset.
};

//! \ingroup group_printing
//! \brief One measurement.
struct VISP_EXPORT vpMotionReading {
  vpMotionReadingKind kind = vpMotionReadingKind::Position; //!< Measured quantity.
  double time = 0.;                                         //!< Time of the measurement (not of its arrival), T.
  double value = 0.;                                        //!< Measured value, L.
  double sigma = 1.;                                        //!< Standard deviation of #value, L, > 0.
};

//! \ingroup group_printing
//! \brief State of the motion at an instant.
struct VISP_EXPORT vpMotionEstimate {
  bool asAsked = true;           //!< False: the requested time is out of range; #time is the time of this state.
  double time = 0.;              //!< Time of the state, T.
  double position = 0.;          //!< Position, L.
  double velocity = 0.;          //!< Velocity, L/T.
  double acceleration = 0.;      //!< Acceleration, L/T^2; 0 with ConstantVelocity.
  double sigmaPosition = 0.;     //!< Standard deviation of the position, L.
  double sigmaVelocity = 0.;     //!< Standard deviation of the velocity, L/T.
  double sigmaAcceleration = 0.; //!< Standard deviation of the acceleration, L/T^2.
  double encoderScale = 0.;      //!< Encoder scale error, no unit.
  double encoderOffset = 0.;     //!< Encoder offset, L.
  double sigmaScale = 0.;        //!< Standard deviation of encoderScale.
  double sigmaOffset = 0.;       //!< Standard deviation of encoderOffset, L.
  //! Covariance of position, velocity and acceleration.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/*!
 * \class vpMotionKalmanFilter
 * \ingroup group_printing
 * \brief Kalman filter of one axis, exact for late and out-of-order readings, with an optional encoder.
 *
 * Readings carry their time of measurement. Those within maxDelay of the newest are kept in order of time and replayed,
 * so the result is that of a filter that received them in order; older ones are final. Missing readings are simply not
 * added. The displacement since the last one is a separate state, which keeps the correlation. Two axes need two
 * filters.
 *
 * Displacement errors are assumed independent. Those of successive frames are not quite (the same error of the middle
 * frame is in both, with opposite signs); Position readings of identified cells are better where available.
 *
 * The standard deviations are those of the spec and of the readings, carried along: they hold as far as these do. The gate
 * keeps out what contradicts them; it is no test of the fit.
 *
 * The third reading of a kind in a row beyond the gate is taken to be right and the belief to be wrong (for an encoder: it has
 * slipped).
 *
 * A reading more than maxGap ahead is rejected, because one wrong time stamp would make all later readings too late.
 * After a longer gap, or when the clock was reset, call reset() with the current time. The filter starts at time 0:
 * call reset() first when the clock does not.
 *
 * add() and at() do not allocate, throw, lock or print.
 *
 * \code
 * vpMotionKalmanFilter filter; // px and frames
 * for (int frame = 2; frame < 50; ++frame) {
 *   const double captured = frame - 1.3; // the image is late
 *   if (filter.add({vpMotionReadingKind::Position, captured, 5. * captured, 0.02}) != vpMotionReadingResult::Used) {
 *     std::cerr << "not used, " << filter.outliers() << " outliers so far" << std::endl;
 *   }
 * }
 * const vpMotionEstimate present = filter.at(50.);
 * if (present.asAsked) {
 *   std::cout << present.position << " +- " << present.sigmaPosition << " px" << std::endl; // 250
 * }
 * \endcode
 */
class VISP_EXPORT vpMotionKalmanFilter
{
public:
  static constexpr int capacity = 32; //!< Maximum readings kept for replay; beyond it the oldest become final earlier.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  explicit vpMotionKalmanFilter(const vpMotionKalmanSpec &spec = vpMotionKalmanSpec());

  //! Add a reading.
  vpMotionReadingResult add(const vpMotionReading &reading) noexcept;
  /*!
   * The motion at any time, from all readings so far. Before the oldest final time: the state there; more than maxGap
   * after the newest: the state that far ahead; for NaN: the newest.
   */
  [[nodiscard]] vpMotionEstimate at(double time) const noexcept;
  /*!
   * Restart at a known state, with the uncertainty of the specification.
   * \param time, position, velocity : T, L, L/T. Ignored when not finite or beyond vpPrintingLargest.
   */
  void reset(double time, double position = 0., double velocity = 0.) noexcept;
  //! Number of readings rejected by the gate since reset().
  [[nodiscard]] int outliers() const { return m_outliers; }
  //! Specification as given.
  [[nodiscard]] const vpMotionKalmanSpec &spec() const { return m_spec; }

private:
  static constexpr int states =
      6; // position, velocity, acceleration, displacement since the mark, encoder offset, scale
  using Vector = Eigen::Matrix<double, states, 1>;
  using Matrix = Eigen::Matrix<double, states, states>;
  //! \brief Estimate at a time.
  struct Belief {
    double time = 0.;
    Vector x = Vector::Zero();
    Matrix P = Matrix::Zero();
    bool marked = false;
    std::array<int, 4> refused{}; // consecutive readings of each kind beyond the gate
  };
  void predict(Belief &belief, double time) const noexcept;
  vpMotionReadingResult correct(Belief &belief, const vpMotionReading &reading) const noexcept;
  static void mark(Belief &belief) noexcept;
  static void clearMoved(Belief &belief) noexcept;
  [[nodiscard]] static bool isSound(const Belief &belief) noexcept;
  [[nodiscard]] vpMotionReadingResult resultOf(Belief &belief, const vpMotionReading &reading) const noexcept;
  void settleOldest() noexcept;

  vpMotionKalmanSpec m_spec;
  Belief m_settled;                                // from all final readings
  Belief m_newest;                                 // from all readings
  std::array<vpMotionReading, capacity> m_pending; // in order of time
  int m_count = 0;
  int m_outliers = 0;
};

END_VISP_NAMESPACE
#endif
