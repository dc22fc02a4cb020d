/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include <visp3/avoidance/vpPotentialField.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the potential field");
} // namespace

void vpFieldWeightSpec::validate(vpFieldForm form) const
{
  fields.positive("centre", centre);
  fields.positive("width", width);
  fields.positive("height", height);
  fields.require(std::isfinite(height) && (form == vpFieldForm::Thesis || height == 0.5), "height", height,
                 "0.5 in the corrected form");
}

double vpFieldWeight(const vpFieldWeightSpec &spec, vpFieldForm form, double distance) noexcept
{
  if (std::isnan(distance)) { // as in contact
    return vpFieldWeight(spec, form, 0.);
  }
  const double d = form == vpFieldForm::Thesis ? distance : std::max(0., distance);
  const double w =
      spec.height * (std::tanh((d + spec.centre) / spec.width) - std::tanh((d - spec.centre) / spec.width));
  return form == vpFieldForm::Thesis ? w : std::min(1., w / std::tanh(spec.centre / spec.width));
}

Eigen::Vector3d blendAsPrinted(const vpFieldWeightSpec &spec, const Eigen::Vector2d &offset,
                               const Eigen::Vector3d &avoid, const Eigen::Vector3d &task) noexcept
{
  Eigen::Vector3d result = task;
  for (int l = 0; l < 2; ++l) {
    const double w = vpFieldWeight(spec, vpFieldForm::Thesis, offset(l));
    result(l) = w * avoid(l) + (1. - w) * task(l);
  }
  return result;
}

Eigen::Vector3d blendRadial(const vpFieldWeightSpec &spec, double distance, const Eigen::Vector3d &normal, double speed,
                            const Eigen::Vector3d &task) noexcept
{
  const double w = vpFieldWeight(spec, vpFieldForm::Corrected, distance);
  const double along = task.dot(normal); // < 0: towards the obstacle
  const double blended = w * speed + (1. - w) * along;
  return task + (std::max(along, blended) - along) * normal;
}

END_VISP_NAMESPACE
