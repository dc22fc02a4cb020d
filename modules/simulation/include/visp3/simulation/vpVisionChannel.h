/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpVisionChannel.h
 * \brief When a camera exposes and when its result arrives.
 */
#ifndef vpVisionChannel_h
#define vpVisionChannel_h

#include <visp3/feedforward/vpServoMeasurement.h>

#include <deque>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpVisionChannel
 * \ingroup group_simulation
 * \brief Frame rate and latency of a vision system: results come out in the order of their exposures, none is lost,
 * each with its time of capture (vpServoMeasurement::time).
 */
class VISP_EXPORT vpVisionChannel
{
public:
  /*!
   * \param frameRate : Exposures per second, Hz, > 0. \param latency : From exposure to result, s, >= 0.
   * \throw vpException (badValue) naming the argument and its value.
   */
  vpVisionChannel(double frameRate, double latency);

  //! Whether an exposure is due at time \e now, s. The first one is due at 0.
  [[nodiscard]] bool due(double now) const;
  //! Hand in what the exposure at \e measurement.time saw. Times must not decrease.
  void push(const vpServoMeasurement &measurement);
  /*!
   * Take the oldest result that has arrived by time \e now, s. Call it until it says no: there may be more than one.
   * \return False, and \e result untouched, when there is none.
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
