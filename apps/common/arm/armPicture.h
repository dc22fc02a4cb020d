/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armPicture.h
 * \brief An arm among obstacles, seen from above and from the side, as SVG, static or animated.
 */
#ifndef vpApp_armPicture_h
#define vpApp_armPicture_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <array>
#include <string>
#include <vector>

namespace vpApp
{
//! \brief View direction of an orthographic figure, along the axes of the base.
enum class ArmView {
  Top,  //!< x to the right, y up.
  Side, //!< y to the right, z up: seen along -x.
  Front //!< x to the right, z up: seen along y.
};

//! \brief The arm at one configuration: its capsules, and a dot for the tool.
struct ArmGhost {
  vpJointVector q;
  std::string colour = "#44546a"; //!< #rrggbb
  double opacity = 1.;            //!< 0..1
};

//! \brief A solid part in one colour, drawn as its silhouette: the exact shape of a link.
struct ArmPart {
  vpCollisionObject object;
  std::string colour = "#c9d1d9"; //!< #rrggbb
};

//! \brief Path of a point, such as the tool.
struct ArmTrace {
  std::vector<Eigen::Vector3d> points; //!< In the base frame, m.
  std::string colour = "#000000";      //!< #rrggbb
  bool dashed = false;
  std::string label; //!< Legend entry; empty for none.
};

//! \brief A labelled point.
struct ArmMark {
  Eigen::Vector3d place; //!< In the base frame, m.
  std::string label;
};

//! \brief Content of a figure.
struct ArmPicture {
  std::string title;
  std::vector<vpCollisionObject> objects; //!< Obstacles at their poses, drawn with inflation.
  std::vector<vpCollisionObject> faint;   //!< Obstacles at other poses: at the start, as seen.
  bool ground = false;                    //!< A line at z = 0 in the right view.
  std::vector<ArmPart> parts;             //!< Below the ghosts, the nearest to the viewer on top.
  std::vector<ArmGhost> ghosts;           //!< Drawn in this order.
  std::vector<ArmTrace> traces;
  std::vector<ArmMark> marks;
  std::array<ArmView, 2> views{ArmView::Top, ArmView::Side}; //!< Left and right.
};

//! Both views side by side at the same scale, as an SVG document.
[[nodiscard]] std::string armPictureSvg(const vpArmModel &arm, const ArmPicture &picture);

//! \brief One instant of an animation.
struct ArmFrame {
  double time = 0.;                      //!< s, increasing.
  vpJointVector q;                       //!< Configuration of the arm.
  std::vector<vpRigidTransform> objects; //!< Poses of ArmAnimation::objects, without rotation.
  std::vector<bool> visible;             //!< Visibility of the objects; empty: all visible.
  std::string caption;                   //!< For example the status.
};

//! \brief Content of an animation.
struct ArmAnimation {
  std::string title;
  std::vector<vpCollisionObject> objects; //!< Moving objects; all others are in #still.
  std::vector<vpCollisionObject> still;
  bool ground = false;
  std::vector<ArmTrace> traces;
  std::vector<ArmMark> marks;
  std::vector<ArmFrame> frames; //!< At least one.
};

/*!
 * Both views with a slider and a button, as an HTML fragment with its own script: no codec, no other file.
 * \param id : Id of the element, unique in the page; letters and digits.
 */
[[nodiscard]] std::string armAnimationHtml(const vpArmModel &arm, const ArmAnimation &animation, const std::string &id);
} // namespace vpApp

#endif
