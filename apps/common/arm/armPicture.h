/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armPicture.h
 * \brief An arm among obstacles, seen from above and from the side, as SVG, still or moving.
 */
#ifndef vpApp_armPicture_h
#define vpApp_armPicture_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <string>
#include <vector>

namespace vpApp
{
//! \brief From where an orthographic picture is taken. The base's axes.
enum class ArmView {
  Top, //!< x to the right, y up.
  Side //!< y to the right, z up: seen along -x.
};

//! \brief The arm in one configuration: its capsules, and a dot for the tool.
struct ArmGhost {
  vpJointVector q;
  std::string colour = "#44546a"; //!< #rrggbb
  double opacity = 1.;            //!< 0..1
};

//! \brief A way of a point, such as the tool's.
struct ArmTrace {
  std::vector<Eigen::Vector3d> points; //!< In the base, m.
  std::string colour = "#000000";      //!< #rrggbb
  bool dashed = false;
  std::string label; //!< In the legend; empty for none.
};

//! \brief A place with a name.
struct ArmMark {
  Eigen::Vector3d place; //!< In the base, m.
  std::string label;
};

//! \brief What to draw.
struct ArmPicture {
  std::string title;
  std::vector<vpCollisionObject> objects; //!< Obstacles where they are. What is inflated is drawn so.
  std::vector<vpCollisionObject> faint;   //!< The same elsewhere: where they come from, how they were seen.
  bool ground = false;                    //!< A line at z = 0 in the side view.
  std::vector<ArmGhost> ghosts;           //!< Drawn in this order.
  std::vector<ArmTrace> traces;
  std::vector<ArmMark> marks;
};

//! Both views beside each other, to the same scale. An SVG document.
[[nodiscard]] std::string armPictureSvg(const vpArmModel &arm, const ArmPicture &picture);

//! \brief One instant of an animation.
struct ArmFrame {
  double time = 0.;                      //!< s, increasing.
  vpJointVector q;                       //!< Of the arm.
  std::vector<vpRigidTransform> objects; //!< Poses of ArmAnimation::objects; not turned.
  std::vector<bool> visible;             //!< Of the same; empty: all are there.
  std::string caption;                   //!< Such as the status.
};

//! \brief What to animate.
struct ArmAnimation {
  std::string title;
  std::vector<vpCollisionObject> objects; //!< What may move, all there is else in #still.
  std::vector<vpCollisionObject> still;
  bool ground = false;
  std::vector<ArmTrace> traces;
  std::vector<ArmMark> marks;
  std::vector<ArmFrame> frames; //!< At least one.
};

/*!
 * Both views with a slider and a button, as a piece of HTML with its own script: no codec, no other file.
 * \param id : Of the element, only once in a page; letters and digits.
 */
[[nodiscard]] std::string armAnimationHtml(const vpArmModel &arm, const ArmAnimation &animation, const std::string &id);
} // namespace vpApp

#endif
