/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpVisionChannel.h
 * \brief Exposure and arrival times of vision results.
 */
#ifndef vpVisionChannel_h
#define vpVisionChannel_h

#include <visp3/feedforward/vpServoMeasurement.h>

#include <deque>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpVisionChannel
 * \ingroup group_simulation
 * \brief Models frame rate and latency of a vision system: results come in the order of their exposures, without loss,
 * each with its time of capture (vpServoMeasurement::time).
 *
 * \code
 * vpVisionChannel channel(10., 0.1); // images at 10 Hz, results 100 ms later
 * for (int k = 0; k < 100; ++k) {
 *   const double time = 0.01 * k; // s
 *   if (channel.due(time)) {
 *     measurement.time = time;
 *     channel.push(measurement);
 *   }
 *   while (channel.pop(time, measurement)) {
 *     std::cout << "at " << time << " s the image of " << measurement.time << " s" << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpVisionChannel
{
public:
  /*!
   * \param frameRate : Exposures per second, Hz, > 0. \param latency : Time from exposure to result, s, >= 0.
   * \throw vpException (badValue) naming the argument and its value.
   */
  vpVisionChannel(double frameRate, double latency);

  //! True if an exposure is due at time \e now, s. The first one is due at 0.
  [[nodiscard]] bool due(double now) const;
  //! Adds the result of the exposure at \e measurement.time. Times must not decrease.
  void push(const vpServoMeasurement &measurement);
  /*!
   * Takes the oldest result that has arrived by time \e now, s. Call until false: there may be more than one.
   * \return False if there is none; \e result is then unchanged.
   */
  [[nodiscard]] bool pop(double now, vpServoMeasurement &result);

private:
  double m_frameRate;
  double m_latency;
  double m_nextFrame = 0.; // number of the next exposure; it is due at m_nextFrame / m_frameRate
  std::deque<vpServoMeasurement> m_pending;
};

END_VISP_NAMESPACE
#endif
