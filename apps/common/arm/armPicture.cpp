/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "armPicture.h"

#include "armCanvas.h"

namespace vpApp
{
namespace
{
constexpr const char *SOLID = "fill=\"#e0a458\" fill-opacity=\"0.45\" stroke=\"#a8641a\" stroke-width=\"1\"";
constexpr const char *FAINT =
    "fill=\"#e0a458\" fill-opacity=\"0.12\" stroke=\"#a8641a\" stroke-width=\"1\" stroke-dasharray=\"4 3\"";
} // namespace

std::string armPictureSvg(const vpArmModel &arm, const ArmPicture &picture)
{
  ArmCanvas canvas(arm);
  for (const std::vector<vpCollisionObject> *list : {&picture.objects, &picture.faint}) {
    for (const vpCollisionObject &object : *list) {
      canvas.show(object);
    }
  }
  for (const ArmGhost &ghost : picture.ghosts) {
    canvas.show(ghost.q);
  }
  for (const ArmTrace &trace : picture.traces) {
    for (const Eigen::Vector3d &p : trace.points) {
      canvas.show(p);
    }
  }
  for (const ArmMark &mark : picture.marks) {
    canvas.show(mark.place);
  }
  canvas.layOut();

  canvas.heading(picture.title, picture.ground);
  for (const vpCollisionObject &object : picture.faint) {
    canvas.object(object, FAINT);
  }
  for (const ArmGhost &ghost : picture.ghosts) {
    canvas.ghost(ghost);
  }
  for (const vpCollisionObject &object : picture.objects) {
    canvas.object(object, SOLID);
  }
  for (const ArmTrace &trace : picture.traces) {
    canvas.trace(trace);
  }
  for (const ArmMark &mark : picture.marks) {
    canvas.mark(mark);
  }
  canvas.legend(picture.traces);
  return canvas.svg();
}
} // namespace vpApp
