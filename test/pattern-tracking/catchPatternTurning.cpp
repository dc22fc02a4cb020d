/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A product that turns, tilts, comes nearer and jumps, against the truth: the lattice must turn along, cells that leave it in
// perspective must be looked for, and after a jump the known cells must be found again.
#include "vpCatch.h"

#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/rendering/vpProductPattern.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr double degrees = M_PI / 180.;

//! How the product is seen at an instant.
struct View {
  double turn = 0.;              //!< In the image, rad.
  double tilt = 0.;              //!< About the axis v, rad: the right gets farther.
  double scale = 1.;             //!< In the middle.
  double x = 0., y = 0.;         //!< Displacement of the product, on the product, px.
  double hidden = HUGE_VAL;      //!< Something covers what is right of this column.
  bool strangers = false;        //!< Round spots, as large as the cells, that are not on the label and stand still.
  double bent = 0.;              //!< The last column of the label is off by so much along the row, px.
  double jumpX = 0., jumpY = 0.; //!< Of its picture, px.
};

//! \brief A camera that looks at the product not only from straight above; its noise is normal, 4 grey values.
class Scene
{
public:
  //! With \e label there are only this many rows and columns of cells, the middle of them in the middle of the picture.
  Scene(const vpProductPatternSpec &product, unsigned int width, unsigned int height, double distance, int label = 0)
    : m_product(onCanvas(product, width, height)), m_width(width), m_height(height), m_distance(distance),
      m_label(label), m_random(product.seed)
  {}

  void render(const View &view, vpImage<unsigned char> &image)
  {
    m_product.expected(fromMiddleX(view), fromMiddleY(view), 0., 0., m_canvas);
    const Eigen::Matrix3d toCanvas = toView(view).inverse();
    const vpProductPatternSpec &spec = m_product.spec();
    const double x0 = m_width - 0.5 + fromMiddleX(view), y0 = m_height - 0.5 + fromMiddleY(view);
    image.resize(m_height, m_width);
    for (unsigned int v = 0; v < m_height; ++v) {
      for (unsigned int u = 0; u < m_width; ++u) {
        const Eigen::Vector3d p = toCanvas * Eigen::Vector3d(u, v, 1.);
        const double x = p[0] / p[2], y = p[1] / p[2];
        const double column = (x - x0) / spec.pitchX, row = (y - y0) / spec.pitchY, last = m_label - 0.5;
        const bool onLabel = m_label == 0 || (column > -0.5 && column < last && row > -0.5 && row < last);
        const double covered = view.strangers ? spec.dark + (spec.bright - spec.dark) * stranger(u, v) : spec.dark;
        const double shown = onLabel && u < view.hidden ? at(column > last - 1. ? x - view.bent : x, y) : covered;
        const double grey = shown + m_noise(m_random);
        image[v][u] = static_cast<unsigned char>(std::lround(std::clamp(grey, 0., 255.)));
      }
    }
  }

  //! Cells whose centre is in the picture.
  std::vector<vpPatternTruthCell> cells(const View &view) const
  {
    std::vector<vpPatternTruthCell> seen;
    const Eigen::Matrix3d h = toView(view);
    for (vpPatternTruthCell cell : m_product.cells(fromMiddleX(view), fromMiddleY(view))) {
      const Eigen::Vector3d p =
          h * Eigen::Vector3d(m_label > 0 && cell.column == m_label - 1 ? cell.x + view.bent : cell.x, cell.y, 1.);
      cell.x = p[0] / p[2];
      cell.y = p[1] / p[2];
      if (isOnLabel(cell.row) && isOnLabel(cell.column) && cell.x > 0. && cell.y > 0. && cell.x < m_width - 1. &&
          cell.y < m_height - 1.) {
        seen.push_back(cell);
      }
    }
    return seen;
  }

private:
  double fromMiddleX(const View &view) const
  {
    return view.x - 0.5 * std::max(0, m_label - 1) * m_product.spec().pitchX;
  }
  double fromMiddleY(const View &view) const
  {
    return view.y - 0.5 * std::max(0, m_label - 1) * m_product.spec().pitchY;
  }
  bool isOnLabel(int number) const { return m_label == 0 || (number >= 0 && number < m_label); }

  static vpProductPatternSpec onCanvas(vpProductPatternSpec product, unsigned int width, unsigned int height)
  {
    product.width = 2 * width;
    product.height = 2 * height;
    return product;
  }

  // From pixels of the canvas to pixels of the picture.
  Eigen::Matrix3d toView(const View &view) const
  {
    Eigen::Matrix3d toMiddle = Eigen::Matrix3d::Identity(), turn = Eigen::Matrix3d::Identity(), look = turn,
                    back = turn;
    toMiddle(0, 2) = -(m_width - 0.5);
    toMiddle(1, 2) = -(m_height - 0.5);
    turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(view.turn).toRotationMatrix();
    look(0, 0) = view.scale * std::cos(view.tilt);
    look(1, 1) = view.scale;
    look(2, 0) = std::sin(view.tilt) / m_distance;
    back(0, 2) = 0.5 * (m_width - 1.) + view.jumpX;
    back(1, 2) = 0.5 * (m_height - 1.) + view.jumpY;
    return back * look * turn * toMiddle;
  }

  // Share of the pixel, about, that one of them covers.
  double stranger(double u, double v) const
  {
    constexpr std::array<std::array<double, 2>, 5> places = {
        {{0.11, 0.25}, {0.15, 0.79}, {0.86, 0.4}, {0.9, 0.83}, {0.54, 0.91}}}; // of the picture
    double most = 0.;
    for (const auto &p : places) {
      const double distance = std::hypot(u - p[0] * m_width, v - p[1] * m_height);
      most = std::max(most, std::clamp(0.5 * m_product.spec().openingX - distance + 0.5, 0., 1.));
    }
    return most;
  }

  // Cubic of third order (Keys 1981); the optics' blur leaves it little to do wrong.
  double at(double x, double y) const
  {
    const double fx = std::floor(x), fy = std::floor(y);
    const auto weights = [](double f) {
      return std::array<double, 4>{((-0.5 * f + 1.) * f - 0.5) * f, (1.5 * f - 2.5) * f * f + 1.,
                                   ((-1.5 * f + 2.) * f + 0.5) * f, (0.5 * f - 0.5) * f * f};
    };
    const auto wx = weights(x - fx), wy = weights(y - fy);
    double sum = 0.;
    for (int r = 0; r < 4; ++r) {
      const int v = std::clamp(static_cast<int>(fy) - 1 + r, 0, static_cast<int>(m_canvas.getHeight()) - 1);
      const float *row = m_canvas[static_cast<unsigned int>(v)];
      for (int c = 0; c < 4; ++c) {
        const int u = std::clamp(static_cast<int>(fx) - 1 + c, 0, static_cast<int>(m_canvas.getWidth()) - 1);
        sum += wy[static_cast<std::size_t>(r)] * wx[static_cast<std::size_t>(c)] * row[u];
      }
    }
    return sum;
  }

  vpProductPattern m_product;
  unsigned int m_width, m_height;
  double m_distance;
  int m_label;
  std::mt19937_64 m_random;
  std::normal_distribution<double> m_noise{0., 4.};
  vpImage<float> m_canvas;
};

//! What the tracker made of a sequence, from its first lock on.
struct Outcome {
  long images = 0, valid = 0, far = 0, slips = 0, lost = 0, degraded = 0, expected = 0;
  double xx = 0., yy = 0., x = 0., y = 0.;
  unsigned int epochs = 0;
  double share() const { return static_cast<double>(valid) / static_cast<double>(std::max(1L, expected)); }
  double biasX() const { return x / static_cast<double>(std::max(1L, valid)); }
  double biasY() const { return y / static_cast<double>(std::max(1L, valid)); }
  double rmsX() const { return std::sqrt(xx / static_cast<double>(std::max(1L, valid))); }
  double rmsY() const { return std::sqrt(yy / static_cast<double>(std::max(1L, valid))); }
};

class Judge
{
public:
  explicit Judge(double margin) : m_margin(margin) {}
  //! A locked image: the cells against the truth; those \e m_margin within the border should be there.
  void add(const vpPatternFrame &frame, const std::vector<vpPatternTruthCell> &truth, unsigned int width,
           unsigned int height)
  {
    if (m_o.images++ == 0) {
      m_firstEpoch = frame.epoch;
    }
    m_o.epochs = frame.epoch - m_firstEpoch;
    m_o.lost += frame.status == vpPatternStatus::Lost ? 1 : 0;
    m_o.degraded += frame.status == vpPatternStatus::Degraded ? 1 : 0;
    for (const vpPatternTruthCell &t : truth) {
      const bool inside =
          t.x > m_margin && t.y > m_margin && t.x < width - 1. - m_margin && t.y < height - 1. - m_margin;
      m_o.expected += inside ? 1 : 0;
      for (const vpPatternCell &cell : frame.cells) {
        const double ex = cell.x - t.x, ey = cell.y - t.y, distance = std::hypot(ex, ey);
        if (!cell.valid || distance > 6.) {
          continue;
        }
        const auto name = std::make_pair(t.row, t.column);
        m_o.slips += m_names.emplace(std::make_pair(cell.row, cell.column), name).first->second != name ? 1 : 0;
        if (inside) {
          ++m_o.valid;
          m_o.far += distance > 1. ? 1 : 0;
          m_o.x += ex;
          m_o.y += ey;
          m_o.xx += ex * ex;
          m_o.yy += ey * ey;
        }
      }
    }
  }
  const Outcome &outcome() const { return m_o; }

private:
  double m_margin;
  unsigned int m_firstEpoch = 0;
  std::map<std::pair<int, int>, std::pair<int, int>> m_names;
  Outcome m_o;
};

vpProductPatternSpec display(unsigned int index)
{
  vpProductPatternSpec spec;
  spec.seed = static_cast<unsigned int>(vpTestSupport::generator(index)());
  return spec;
}

vpProductPatternSpec dots(unsigned int index, double pitch, double opening)
{
  vpProductPatternSpec spec = display(index);
  spec.shape = vpProductShape::Dot;
  spec.pitchX = spec.pitchY = pitch;
  spec.openingX = spec.openingY = opening;
  return spec;
}

//! From 0 to 1, -1 and back to 0 in straight lines, t in 0..1.
double toAndFro(double t) { return t < 0.25 ? 4. * t : t < 0.75 ? 2. - 4. * t : 4. * t - 4.; }

constexpr int settling = 110; // images until the tracker is locked

//! Track images 0 to \e images - 1 after learning; \e motion gives the view of an image.
template <typename Motion>
Outcome follow(Scene &scene, unsigned int width, unsigned int height, int images, double margin, Motion motion)
{
  vpPatternTracker tracker(width, height);
  vpImage<unsigned char> image;
  Judge judge(margin);
  for (int k = -settling; k < images; ++k) {
    const View view = motion(k);
    scene.render(view, image);
    const vpPatternFrame &frame = tracker.process(image);
    if (k >= 0) {
      judge.add(frame, scene.cells(view), width, height);
    }
  }
  return judge.outcome();
}

void checkNames(const Outcome &o)
{
  CHECK(o.lost == 0);
  CHECK(o.degraded == 0);
  CHECK(o.epochs == 0);
  CHECK(o.slips == 0);
  CHECK(o.far == 0);
}
} // namespace

TEST_CASE("a product that turns by 8 degrees to and fro is tracked as well as one that does not", "[pattern][turning]")
{
  CAPTURE(vpTestSupport::seed());
  const double step = GENERATE(0.02, 0.1); // degrees from image to image
  CAPTURE(step);
  Scene scene(display(480), 160, 100, 400.);
  const int images = static_cast<int>(32. / step);
  const Outcome o = follow(scene, 160, 100, images, 25., [&](int k) {
    View view;
    view.turn = k < 0 ? 0. : 8. * degrees * toAndFro(static_cast<double>(k) / images);
    view.x = 2. * k;
    return view;
  });
  checkNames(o);
  CHECK(o.share() > 0.99);
  CHECK(std::abs(o.biasX()) < 0.003);
  CHECK(std::abs(o.biasY()) < 0.003);
  CHECK(o.rmsX() < 1.1 * 0.0149); // the bound of this product at rest
  CHECK(o.rmsY() < 1.2 * 0.0075);
}

TEST_CASE("a product that tilts by 6 degrees and comes nearer by a tenth is followed", "[pattern][turning]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene(display(481), 160, 100, 400.);
  constexpr int images = 1200;
  const Outcome o = follow(scene, 160, 100, images, 25., [&](int k) {
    View view;
    const double t = k < 0 ? 0. : toAndFro(static_cast<double>(k) / images);
    view.tilt = 6. * degrees * t;
    view.scale = 1. + 0.1 * t;
    view.x = 2. * k;
    return view;
  });
  // In 5 of 24 seeds the names are given anew, up to four times; none is wrong.
  CHECK(o.lost == 0);
  CHECK(o.slips == 0);
  CHECK(o.far == 0);
  CHECK(o.epochs <= 8);
  CHECK(o.degraded <= 12);
  CHECK(o.share() > 0.965 - 0.015 * o.epochs);
  CHECK(o.rmsX() < 0.1); // one template for cells of different size
  CHECK(o.rmsY() < 0.02);
}

TEST_CASE("cells that leave their place unseen while the product turns are looked for", "[pattern][turning]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene(dots(482, 45., 20.), 240, 200, 400., 3);
  constexpr int images = 300, from = 80, to = 120;
  const Outcome o = follow(scene, 240, 200, images, 20., [&](int k) {
    View view;
    view.turn = k < 0 ? 0. : 0.1 * degrees * k;
    view.hidden = k >= from && k < to ? 135. : HUGE_VAL; // a third of the cells, which bend off meanwhile
    view.bent = k >= 90 ? 4.5 : 0.;
    return view;
  });
  checkNames(o);
  CHECK(o.share() > 1. - (to - from) / 3. / images - 0.01);
  CHECK(o.rmsX() < 0.015);
}

TEST_CASE("a jump by less than half a pitch is recognised, or reported by a new epoch", "[pattern][turning]")
{
  CAPTURE(vpTestSupport::seed());
  const auto jump = GENERATE(std::make_pair(0.38, -0.2), std::make_pair(-0.35, 0.1), std::make_pair(0.25, 0.25),
                             std::make_pair(-0.2, -0.3)); // of the pitch
  CAPTURE(jump.first, jump.second);
  vpProductPatternSpec spec = dots(483, 40., 18.);
  spec.jitter = 1.;
  Scene scene(spec, 200, 150, 400., 3);
  const Outcome o = follow(scene, 200, 150, 150, 20., [&](int k) {
    View view;
    view.strangers = k >= 50;
    view.jumpX = k < 110 ? 0. : spec.pitchX * jump.first;
    view.jumpY = k < 110 ? 0. : spec.pitchY * jump.second;
    return view;
  });
  // With one product in ten the strangers leave a doubt: the numbers start anew then, which the epoch tells. A cell never
  // gets a wrong name, and none is lost.
  CHECK(o.lost == 0);
  CHECK(o.slips == 0);
  CHECK(o.far == 0);
  CHECK(o.share() > 0.99);
  CHECK(o.rmsX() < 0.02);
}

// Here the spots alone show no lattice: there are more strangers than cells.
TEST_CASE("after a jump the known cells are found among more strangers", "[pattern][turning]")
{
  CAPTURE(vpTestSupport::seed());
  const double tilt = GENERATE(0., 10.);
  CAPTURE(tilt);
  const vpProductPatternSpec spec = dots(483, 50., 22.);
  Scene scene(spec, 200, 150, 400., 2);
  const Outcome o = follow(scene, 200, 150, 150, 20., [&](int k) {
    View view;
    view.strangers = k >= 50;
    view.tilt = k < 0 ? 0. : tilt * degrees * std::min(1., k / 100.);
    view.jumpX = k < 110 ? 0. : 0.38 * spec.pitchX;
    view.jumpY = k < 110 ? 0. : -0.2 * spec.pitchY;
    return view;
  });
  CHECK(o.lost == 0);
  CHECK(o.slips == 0);
  CHECK(o.far == 0);
  CHECK(o.epochs <= 1); // tilted, in 1 of 20 seeds the jump gives new names
  CHECK(o.degraded <= 1);
  CHECK(o.share() > 0.98);
  CHECK(o.rmsX() < 0.06); // one template for cells of different size
}
