/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/printing/vpPrintUnits.h"
#include "vpFieldCheck.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <complex>

BEGIN_VISP_NAMESPACE

namespace
{
//! \brief Conversion between two systems of units; see the table of vpPrintUnits.
class Change
{
public:
  Change(const vpPrintUnits &from, const vpPrintUnits &to)
    : m_length(from.pixelSize / to.pixelSize), m_time(to.frameRate / from.frameRate)
  {
    from.validate();
    to.validate();
  }
  //! Converts a quantity of the unit L^length T^time.
  void operator()(double &value, int length, int time) const
  {
    value *= std::pow(m_length, length) * std::pow(m_time, time);
  }
  void operator()(int &frames) const { frames = static_cast<int>(std::lround(frames * m_time)); }
  [[nodiscard]] double time() const { return m_time; }

private:
  double m_length, m_time; // new units per old unit
};

void change(vpFrictionModel &model, const Change &by)
{
  by(model.viscous, 0, -1);
  by(model.coulomb, 1, -2);
  by(model.stiction, 1, -2);
  by(model.stribeckVelocity, 1, -1);
}

void change(vpXYStageAxis &axis, const Change &by)
{
  by(axis.viscous, 0, -1);
  by(axis.coulomb, 1, -2);
  by(axis.stiction, 1, -2);
  by(axis.stribeckVelocity, 1, -1);
  by(axis.viscousRiseFrom, 1, 0);
  by(axis.lag, 0, 1);
  by(axis.delay, 0, 1);
  by(axis.maxVelocity, 1, -1);
}

void change(vpPrintVelocityControlSpec &pid, const Change &by)
{
  by(pid.kp, 0, -1);
  by(pid.ki, 0, -2);
  by(pid.maxForce, 1, -2);
  change(pid.model, by);
}

void change(vpMotionObserverSpec &observer, const Change &by)
{
  change(observer.model, by);
  by(observer.lag, 0, 1);
  by(observer.delay, 0, 1);
  by(observer.velocityNoise, 2, -3);
  by(observer.disturbanceNoise, 2, -5);
  by(observer.changeRate, 0, -1);
  observer.changeRate = std::min(1., observer.changeRate);
  by(observer.sigmaPosition, 1, 0);
  by(observer.sigmaVelocity, 1, -1);
  by(observer.sigmaDisturbance, 1, -2);
  by(observer.maxGap, 0, 1);
  observer.maxGap = std::min(1000., observer.maxGap); // of steps: it bounds the work
}

void change(vpMotionKalmanSpec &kalman, const Change &by)
{
  by(kalman.processNoise, 2, kalman.model == vpMotionModel::ConstantVelocity ? -3 : -5);
  by(kalman.sigmaPosition, 1, 0);
  by(kalman.sigmaVelocity, 1, -1);
  by(kalman.sigmaAcceleration, 1, -2);
  by(kalman.maxDelay, 0, 1);
  by(kalman.encoderOffsetSigma, 1, 0);
  by(kalman.encoderSlip, 2, -1);
  by(kalman.maxGap, 0, 1);
}

void change(vpPreviewControlSpec &preview, const Change &by)
{
  change(preview.model, by);
  by(preview.positionGain, 0, -2);
  by(preview.velocityGain, 0, -1);
  by(preview.lag, 0, 1);
  by(preview.delay, 0, 1);
  by(preview.maxForce, 1, -2);
}

void change(vpPrintReferenceSpec &reference, const Change &by)
{
  by(reference.meanVelocity, 1, -1);
  by(reference.dropTime, 0, 1);
  by(reference.maxVelocity, 1, -1);
  by(reference.maxAcceleration, 1, -2);
  by(reference.freeze, 0, 1);
}

void change(vpProductPatternSpec &product, const Change &by)
{
  for (double *length : {&product.pitchX, &product.pitchY, &product.openingX, &product.openingY, &product.cornerRadius,
                         &product.psf, &product.jitter, &product.flexAmplitudeX, &product.flexAmplitudeY}) {
    by(*length, 1, 0);
  }
  by(product.dust, -2, 0);
  by(product.cracks, -2, 0);
  by(product.exposure, 0, 1);
}

int commandsPerFrame(double wanted)
{
  const double power = std::round(std::log2(wanted));
  return 1 << static_cast<int>(std::clamp(power, 0., 4.));
}
} // namespace

vpPrintUnits vpPrintUnits::of(const vpPrintExperimentSpec &spec) { return {spec.product.pixelSize, spec.frameRate}; }

void vpPrintUnits::validate() const
{
  constexpr vpFieldCheck fields("the units");
  fields.positive("pixelSize", pixelSize);
  fields.positive("frameRate", frameRate);
}

vpXYStageSpec vpInUnits(const vpXYStageSpec &spec, const vpPrintUnits &from, const vpPrintUnits &to)
{
  const Change by(from, to);
  vpXYStageSpec changed = spec;
  change(changed.x, by);
  change(changed.y, by);
  return changed;
}

vpPrintVelocityControlSpec vpInUnits(const vpPrintVelocityControlSpec &spec, const vpPrintUnits &from,
                                     const vpPrintUnits &to)
{
  vpPrintVelocityControlSpec changed = spec;
  change(changed, Change(from, to));
  return changed;
}

vpAlphaBetaGains vpInUnits(const vpAlphaBetaGains &gains, const vpPrintUnits &from, const vpPrintUnits &to)
{
  gains.validate();
  const double slower = 1. / Change(from, to).time();
  if (slower == 1.) {
    return gains;
  }
  const double half = 0.5 * (2. - gains.alpha - gains.beta); // half the sum of the poles
  const std::complex<double> root = std::sqrt(std::complex<double>(half * half - (1. - gains.alpha), 0.));
  std::complex<double> sum = 0., product = 1.;
  for (const std::complex<double> &pole : {half + root, half - root}) {
    const double angle = std::clamp(std::arg(pole) * slower, -M_PI, M_PI);
    const double radius = std::pow(std::abs(pole), slower);
    // A negative real pole oscillates at half the frame rate, which has no counterpart: it keeps its sign.
    const std::complex<double> moved =
        pole.imag() == 0. ? std::copysign(radius, pole.real()) : std::polar(radius, angle);
    sum += moved;
    product *= moved;
  }
  const double alpha = 1. - product.real();
  return {alpha, 2. - alpha - sum.real()};
}

vpPrintExperimentSpec vpInUnits(const vpPrintExperimentSpec &spec, const vpPrintUnits &to)
{
  const vpPrintUnits from = vpPrintUnits::of(spec);
  const Change by(from, to);
  vpPrintExperimentSpec changed = spec;
  changed.stage = vpInUnits(spec.stage, from, to);
  changed.filter = vpInUnits(spec.filter, from, to);
  change(changed.product, by);
  change(changed.pid, by);
  change(changed.forecast, by);
  change(changed.observer, by);
  change(changed.preview, by);
  change(changed.previewAcross, by);
  change(changed.reference, by);
  by(changed.sensorModel.sigmaX, 1, 0);
  by(changed.sensorModel.sigmaY, 1, 0);
  by(changed.dropVelocity, 1, -1);
  by(changed.cellDrift, 2, -1);
  by(changed.nozzleOffset, 1, 0);
  for (double *time : {&changed.visionDelay, &changed.captureJitter, &changed.travelTime, &changed.electronicsDelay,
                       &changed.rowStepTime, &changed.followTime, &changed.filterAhead}) {
    by(*time, 0, 1);
  }
  by(changed.frames);
  by(changed.evaluateFrom);
  changed.commandsPerFrame = commandsPerFrame(spec.commandsPerFrame / by.time());
  changed.product.pixelSize = to.pixelSize;
  changed.frameRate = to.frameRate;
  return changed;
}

END_VISP_NAMESPACE
