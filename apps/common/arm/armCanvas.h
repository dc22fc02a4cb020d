/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file armCanvas.h
 * \brief Two orthographic views side by side as SVG elements.
 */
#ifndef vpApp_armCanvas_h
#define vpApp_armCanvas_h

#include "shapeOutline.h"

namespace vpApp
{
//! \brief Maps metres to pixels and collects the drawing. First show() everything that must fit, then draw.
class ArmCanvas
{
public:
  //! Left and right.
  const std::array<ArmView, 2> views;

  //! \param id : Prefix of the names in the document; unique among the documents of a page.
  explicit ArmCanvas(const vpArmModel &arm, std::string id = "view",
                     std::array<ArmView, 2> both = {ArmView::Top, ArmView::Side})
    : views(both), m_arm(&arm), m_id(std::move(id))
  {}

  void show(const vpCollisionObject &object); //!< Extend the views to the object.
  void show(const Eigen::Vector3d &place);    //!< Extend the views to the point.
  void show(const vpJointVector &q);          //!< Extend the views to the arm.
  void layOut();                              //!< Fix the scale.

  void heading(const std::string &title, bool ground);
  //! Draw an object; parts outside a view are clipped.
  void object(const vpCollisionObject &object, const std::string &attributes);
  //! Draw parts, the nearest last.
  void parts(const std::vector<ArmPart> &parts);
  void ghost(const ArmGhost &ghost);
  void trace(const ArmTrace &trace);
  void mark(const ArmMark &mark);
  //! Legend of the traces with a label.
  void legend(const std::vector<ArmTrace> &traces);
  void add(const std::string &element) { m_elements += element; }

  //! Pixel of a point.
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector3d &place, ArmView view) const;
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d &projected, ArmView view) const;
  //! Pixels per metre.
  [[nodiscard]] double scale() const { return m_scale; }
  //! SVG attribute "points" of a polygon.
  [[nodiscard]] std::string points(const Polygon &polygon, ArmView view) const;
  //! The document. \param attributes : Attributes of its root element.
  [[nodiscard]] std::string svg(const std::string &attributes = "") const;

private:
  struct Frame {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(-0.1),
                    high = Eigen::Vector2d::Constant(0.1); // m, contains at least the base
    Eigen::Vector2d corner = Eigen::Vector2d::Zero();      // px, top left
  };
  [[nodiscard]] Frame &frame(ArmView view) { return m_frames[view == views[0] ? 0 : 1]; }
  [[nodiscard]] const Frame &frame(ArmView view) const { return m_frames[view == views[0] ? 0 : 1]; }
  void include(const Eigen::Vector2d &p, ArmView view, double room);

  const vpArmModel *m_arm;
  std::string m_id;
  Frame m_frames[2];
  double m_scale = 1.;
  double m_height = 0.;
  std::string m_elements;
};

//! Pixels as text, to a tenth.
[[nodiscard]] std::string px(double value);

//! Capsules and tool of an arm at a configuration, in the base frame.
struct PlacedArm {
  std::vector<vpPlacedCapsule> capsules;
  Eigen::Vector3d tool = Eigen::Vector3d::Zero();
};
[[nodiscard]] PlacedArm placeArm(const vpArmModel &arm, const vpJointVector &q);
} // namespace vpApp

#endif
