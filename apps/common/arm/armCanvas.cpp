/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "armCanvas.h"

#include "htmlReport.h"
#include "numberText.h"

#include <opencv2/imgproc.hpp>

#include <visp3/manipulator/vpArmKinematics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vpApp
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double WIDTH = 960.; // px
constexpr double GAP = 30.;    // px, around and between the views
constexpr double HEAD = 46.;   // px, title and view names
constexpr int CORNERS = 40;    // of a circle

double cross(const Vector2d &o, const Vector2d &a, const Vector2d &b)
{
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

//! Points whose hull, thickened by a radius, is the shape.
std::vector<Vector3d> core(const vpCollisionShape &shape)
{
  std::vector<Vector3d> points;
  const Vector3d half = 0.5 * shape.size();
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return {Vector3d::Zero()};
  case vpShapeType::Capsule:
    return {{0., 0., 0.5 * shape.length()}, {0., 0., -0.5 * shape.length()}};
  case vpShapeType::Box:
    for (int i = 0; i < 8; ++i) {
      points.emplace_back((i & 1 ? 1. : -1.) * half.x(), (i & 2 ? 1. : -1.) * half.y(), (i & 4 ? 1. : -1.) * half.z());
    }
    return points;
  default: // a cylinder
    for (int i = 0; i < 2 * CORNERS; ++i) {
      const double angle = 2. * M_PI * i / CORNERS;
      points.emplace_back(shape.radius() * std::cos(angle), shape.radius() * std::sin(angle),
                          (i < CORNERS ? 0.5 : -0.5) * shape.length());
    }
    return points;
  }
}

double thickness(const vpCollisionObject &object)
{
  const vpShapeType type = object.shape.type();
  const bool round = type == vpShapeType::Sphere || type == vpShapeType::Capsule;
  return (round ? object.shape.radius() : 0.) + object.inflation;
}

std::string text(double x, double y, const std::string &what, const std::string &attributes = "")
{
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" " + attributes + ">" + escapeHtml(what) + "</text>\n";
}

//! Mean of the vertices of a mesh, else the origin, in the base frame.
Vector3d middle(const vpCollisionObject &object)
{
  Vector3d centre = Vector3d::Zero();
  if (object.shape.type() == vpShapeType::Mesh) {
    const vpTriangleMesh &mesh = object.shape.mesh();
    for (const Vector3d &p : mesh.vertices()) {
      centre += p / static_cast<double>(mesh.vertices().size());
    }
  }
  return object.pose.R * centre + object.pose.p;
}

const char *nameOf(ArmView view)
{
  return view == ArmView::Top    ? "from above: x right, y up"
         : view == ArmView::Side ? "from the side: y right, z up"
                                 : "from the side: x right, z up";
}

std::string line(const Vector2d &a, const Vector2d &b, const std::string &attributes)
{
  return "<line x1=\"" + px(a.x()) + "\" y1=\"" + px(a.y()) + "\" x2=\"" + px(b.x()) + "\" y2=\"" + px(b.y()) + "\" " +
         attributes + "/>\n";
}
} // namespace

Vector2d project(const Vector3d &place, ArmView view)
{
  switch (view) {
  case ArmView::Top:
    return {place.x(), place.y()};
  case ArmView::Side:
    return {place.y(), place.z()};
  default:
    return {place.x(), place.z()};
  }
}

double nearness(const Vector3d &place, ArmView view)
{
  return view == ArmView::Top ? place.z() : view == ArmView::Side ? place.x() : -place.y();
}

std::vector<Polygon> silhouette(const std::vector<Polygon> &polygons, double step)
{
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Polygon &polygon : polygons) {
    for (const Vector2d &p : polygon) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  constexpr double largest = 4000.; // pixels across
  if (!((high - low).maxCoeff() < largest * step)) {
    return polygons;
  }
  low -= Vector2d::Constant(2. * step);
  const Vector2d size = (high - low) / step;
  cv::Mat mask(static_cast<int>(size.y()) + 3, static_cast<int>(size.x()) + 3, CV_8UC1, cv::Scalar(0));
  for (const Polygon &polygon : polygons) {
    std::vector<cv::Point> corners;
    for (const Vector2d &p : polygon) {
      corners.emplace_back(cvRound((p.x() - low.x()) / step), cvRound((p.y() - low.y()) / step));
    }
    cv::fillConvexPoly(mask, corners, cv::Scalar(255));
  }
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  std::vector<Polygon> result;
  for (const std::vector<cv::Point> &contour : contours) {
    std::vector<cv::Point> fewer;
    cv::approxPolyDP(contour, fewer, 0.7, true);
    Polygon polygon;
    for (const cv::Point &p : fewer) {
      polygon.push_back(low + step * Vector2d(p.x, p.y));
    }
    result.push_back(polygon);
  }
  return result;
}

Polygon convexHull(std::vector<Vector2d> points)
{
  std::sort(points.begin(), points.end(),
            [](const Vector2d &a, const Vector2d &b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  Polygon hull;
  for (int pass = 0; pass < 2; ++pass) { // below, then above
    const std::size_t begin = hull.size();
    for (const Vector2d &p : points) {
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back(); // equals the first of the other pass
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<Polygon> outline(const vpCollisionObject &object, ArmView view)
{
  const auto place = [&](const Vector3d &p) { return project(object.pose.R * p + object.pose.p, view); };
  std::vector<Polygon> polygons;
  if (object.shape.type() == vpShapeType::Mesh) {
    for (const auto &triangle : object.shape.mesh().triangles()) {
      Polygon polygon;
      for (const int corner : triangle) {
        polygon.push_back(place(object.shape.mesh().vertices()[static_cast<std::size_t>(corner)]));
      }
      polygons.push_back(polygon);
    }
    return polygons;
  }
  if (object.shape.type() == vpShapeType::Octree) {
    for (const vpOctreeCell &cell : object.shape.octree().cells()) {
      std::vector<Vector2d> corners;
      for (const Vector3d &corner : core(vpCollisionShape::box(Vector3d::Constant(cell.size)))) {
        corners.push_back(place(cell.centre + corner));
      }
      polygons.push_back(convexHull(corners));
    }
    return polygons;
  }
  std::vector<Vector2d> points;
  const double r = thickness(object);
  for (const Vector3d &p : core(object.shape)) {
    for (int i = 0; i < (r > 0. ? CORNERS : 1); ++i) {
      const double angle = 2. * M_PI * i / CORNERS;
      points.push_back(place(p) + r * Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  return {convexHull(points)};
}

std::string px(double value) { return number(std::round(10. * value) / 10., 6); }

PlacedArm placeArm(const vpArmModel &arm, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::forward(arm, q, data);
  PlacedArm placed;
  for (const vpArmCapsule &capsule : arm.spec().capsules) {
    const vpRigidTransform link = vpArmKinematics::link(arm, data, capsule.link);
    vpPlacedCapsule at;
    at.from = link.R * capsule.from + link.p;
    at.to = link.R * capsule.to + link.p;
    at.radius = capsule.radius;
    placed.capsules.push_back(at);
  }
  placed.tool = data.tool.p;
  return placed;
}

void ArmCanvas::include(const Vector2d &p, ArmView view, double room)
{
  frame(view).low = frame(view).low.cwiseMin(p - Vector2d::Constant(room));
  frame(view).high = frame(view).high.cwiseMax(p + Vector2d::Constant(room));
}

void ArmCanvas::show(const vpCollisionObject &object)
{
  for (const ArmView view : views) {
    for (const Polygon &polygon : outline(object, view)) {
      for (const Vector2d &p : polygon) {
        include(p, view, 0.);
      }
    }
  }
}

void ArmCanvas::show(const Vector3d &place)
{
  for (const ArmView view : views) {
    include(project(place, view), view, 0.03);
  }
}

void ArmCanvas::show(const vpJointVector &q)
{
  const PlacedArm placed = placeArm(*m_arm, q);
  for (const vpPlacedCapsule &capsule : placed.capsules) {
    for (const ArmView view : views) {
      include(project(capsule.from, view), view, capsule.radius);
      include(project(capsule.to, view), view, capsule.radius);
    }
  }
  show(placed.tool);
}

void ArmCanvas::layOut()
{
  const Vector2d top = m_frames[0].high - m_frames[0].low, side = m_frames[1].high - m_frames[1].low;
  m_scale = std::min(420., (WIDTH - 3. * GAP) / (top.x() + side.x()));
  m_frames[0].corner = {GAP, HEAD};
  m_frames[1].corner = {2. * GAP + m_scale * top.x(), HEAD};
  m_height = HEAD + m_scale * std::max(top.y(), side.y()) + GAP;
}

Vector2d ArmCanvas::pixel(const Vector2d &projected, ArmView view) const
{
  const Frame &f = frame(view);
  return f.corner + m_scale * Vector2d(projected.x() - f.low.x(), f.high.y() - projected.y());
}

Vector2d ArmCanvas::pixel(const Vector3d &place, ArmView view) const { return pixel(project(place, view), view); }

std::string ArmCanvas::points(const Polygon &polygon, ArmView view) const
{
  std::string list;
  for (const Vector2d &p : polygon) {
    const Vector2d at = pixel(p, view);
    list += (list.empty() ? "" : " ") + px(at.x()) + "," + px(at.y());
  }
  return list;
}

void ArmCanvas::heading(const std::string &title, bool ground)
{
  add(text(GAP, 18., title, "font-size=\"15\" font-weight=\"600\""));
  for (int i = 0; i < 2; ++i) {
    add(text(m_frames[i].corner.x(), HEAD - 8., nameOf(views[static_cast<std::size_t>(i)]),
             "font-size=\"12\" fill=\"#666666\""));
  }
  for (int i = 0; i < 2; ++i) { // half the gap belongs to each view
    const Vector2d size = m_scale * (m_frames[i].high - m_frames[i].low) + Vector2d(GAP, 10.);
    add("<clipPath id=\"" + escapeHtml(m_id) + std::to_string(i) + "\"><rect x=\"" +
        px(m_frames[i].corner.x() - 0.5 * GAP) + "\" y=\"" + px(m_frames[i].corner.y() - 5.) + "\" width=\"" +
        px(size.x()) + "\" height=\"" + px(size.y()) + "\"/></clipPath>\n");
  }
  const Frame &f = m_frames[1];
  if (ground) {
    add(line(pixel(Vector2d(f.low.x(), 0.), views[1]), pixel(Vector2d(f.high.x(), 0.), views[1]),
             "stroke=\"#999999\" stroke-width=\"1.5\""));
  }
  const Vector2d from(GAP, m_height - 10.); // scale bar of a decimetre
  add(line(from, from + Vector2d(0.1 * m_scale, 0.), "stroke=\"#333333\" stroke-width=\"2\""));
  add(text(from.x() + 0.1 * m_scale + 6., from.y() + 4., "0.1 m", "font-size=\"11\" fill=\"#333333\""));
}

void ArmCanvas::object(const vpCollisionObject &object, const std::string &attributes)
{
  for (int i = 0; i < 2; ++i) {
    add("<g clip-path=\"url(#" + escapeHtml(m_id) + std::to_string(i) + ")\">\n");
    const ArmView view = views[static_cast<std::size_t>(i)];
    for (const Polygon &polygon : outline(object, view)) {
      add("<polygon points=\"" + points(polygon, view) + "\" " + attributes + "/>\n");
    }
    add("</g>\n");
  }
}

void ArmCanvas::parts(const std::vector<ArmPart> &parts)
{
  for (const ArmView view : views) {
    std::vector<std::pair<double, const ArmPart *>> order;
    for (const ArmPart &part : parts) {
      order.emplace_back(nearness(middle(part.object), view), &part);
    }
    std::stable_sort(order.begin(), order.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    for (const auto &[near, part] : order) {
      std::string path;
      for (const Polygon &polygon : silhouette(outline(part->object, view), 0.5 / m_scale)) {
        path += "M" + points(polygon, view) + "Z";
      }
      add("<path d=\"" + path + "\" fill=\"" + escapeHtml(part->colour) +
          "\" fill-rule=\"evenodd\" stroke=\"#44546a\" stroke-width=\"0.8\"/>\n");
    }
  }
}

void ArmCanvas::ghost(const ArmGhost &ghost)
{
  const PlacedArm placed = placeArm(*m_arm, ghost.q);
  for (const ArmView view : views) {
    add("<g stroke=\"" + escapeHtml(ghost.colour) + "\" fill=\"" + escapeHtml(ghost.colour) + "\" opacity=\"" +
        number(ghost.opacity, 3) + "\" stroke-linecap=\"round\">\n");
    for (const vpPlacedCapsule &c : placed.capsules) {
      add(line(pixel(c.from, view), pixel(c.to, view), "stroke-width=\"" + px(2. * c.radius * m_scale) + "\""));
    }
    const Vector2d wrist = pixel(placed.capsules.empty() ? placed.tool : placed.capsules.back().to, view);
    const Vector2d tool = pixel(placed.tool, view);
    add(line(wrist, tool, "stroke-width=\"3\""));
    add("<circle cx=\"" + px(tool.x()) + "\" cy=\"" + px(tool.y()) + "\" r=\"4\"/></g>\n");
  }
}

void ArmCanvas::trace(const ArmTrace &trace)
{
  for (const ArmView view : views) {
    std::string list;
    for (const Vector3d &p : trace.points) {
      const Vector2d at = pixel(p, view);
      list += (list.empty() ? "" : " ") + px(at.x()) + "," + px(at.y());
    }
    add("<polyline points=\"" + list + "\" fill=\"none\" stroke=\"" + escapeHtml(trace.colour) +
        "\" stroke-width=\"2\"" + (trace.dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n");
  }
}

void ArmCanvas::mark(const ArmMark &mark)
{
  for (const ArmView view : views) {
    const Vector2d at = pixel(mark.place, view);
    add(line(at - Vector2d(5., 0.), at + Vector2d(5., 0.), "stroke=\"#000000\" stroke-width=\"1.5\""));
    add(line(at - Vector2d(0., 5.), at + Vector2d(0., 5.), "stroke=\"#000000\" stroke-width=\"1.5\""));
    add(text(at.x() + 7., at.y() - 5., mark.label,
             "font-size=\"12\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\""));
  }
}

void ArmCanvas::legend(const std::vector<ArmTrace> &traces)
{
  double x = GAP + 90.;
  for (const ArmTrace &trace : traces) {
    if (trace.label.empty()) {
      continue;
    }
    const Vector2d from(x, m_height - 10.);
    add(line(from, from + Vector2d(22., 0.),
             "stroke=\"" + escapeHtml(trace.colour) + "\" stroke-width=\"3\"" +
                 (trace.dashed ? " stroke-dasharray=\"6 4\"" : "")));
    add(text(x + 27., from.y() + 4., trace.label, "font-size=\"12\""));
    x += 45. + 7.2 * static_cast<double>(trace.label.size());
  }
}

std::string ArmCanvas::svg(const std::string &attributes) const
{
  const std::string size = "viewBox=\"0 0 " + px(WIDTH) + " " + px(m_height) + "\"";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " width=\"" + px(WIDTH) + "\" height=\"" + px(m_height) +
         "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" " + attributes + ">\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + m_elements + "</svg>\n";
}
} // namespace vpApp
