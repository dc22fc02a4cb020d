/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoVisionSide.h
 * \brief The part of a vpVisualServo that the vision thread uses.
 */
#ifndef vpServoVisionSide_h
#define vpServoVisionSide_h

#include "vpServoExchange.h"

#include <cstdint>
#include <limits>
#include <memory>

BEGIN_VISP_NAMESPACE

//! Images and goals in; checked, they are handed over.
class vpServoVisionSide
{
public:
  explicit vpServoVisionSide(const vpVisualServoSpec &spec);

  void set(std::unique_ptr<vpServoVision> vision);
  [[nodiscard]] vpServoVision &vision() const;
  void setGoal(const vpServoGoal &goal, vpServoExchange &exchange);
  const vpServoSight &see(const vpImage<unsigned char> &image, double time, vpServoExchange &exchange);
  void see(const vpServoSight &sight, vpServoExchange &exchange);

private:
  [[nodiscard]] bool isNewer(double time, vpServoExchange &exchange);
  [[nodiscard]] bool isFrozen(const vpImage<unsigned char> &image, const vpRigidTransform *camera);
  void publish(const vpServoSight &sight, const vpRigidTransform *camera, bool isFrozen, vpServoExchange &exchange);
  void checkGoal(const vpServoGoal &goal);

  unsigned int m_maxPoints;
  std::unique_ptr<vpServoVision> m_vision;
  std::unique_ptr<vpServoLaw> m_checker; // any law: its setGoal() validates
  vpObjectMotionFilter m_object;
  bool m_objectMoves;
  vpServoSight m_sight;
  double m_lastTime = -std::numeric_limits<double>::infinity();
  unsigned int m_epoch = 0;
  std::uint64_t m_hash = 0;
  vpRigidTransform m_firstOfSame; // camera at the first of several equal images
  bool m_hasFirst = false;
};

END_VISP_NAMESPACE
#endif
