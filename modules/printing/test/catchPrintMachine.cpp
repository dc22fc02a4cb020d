/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The loop of a printing machine on a frictionless stage with motion known in closed form. On simulated stages with
// friction and rendered images the same loop is tested in lab/.
#include "vpCatch.h"
#include "vpWildNumbers.h"

#include <visp3/core/vpException.h>
#include <visp3/printing/vpPrintMachine.h>

#include <functional>
#include <map>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr int commands = 4;

vpPrintMachineSpec idealSpec()
{
  vpPrintMachineSpec spec;
  spec.commandsPerFrame = commands;
  spec.preview.lag = spec.previewAcross.lag = spec.observer.lag = 0.;
  spec.preview.positionGain = spec.previewAcross.positionGain = 0.03;
  spec.preview.velocityGain = spec.previewAcross.velocityGain = 0.5;
  return spec;
}

//! One axis: a mass accelerated by each command for a quarter of a frame.
class Mass
{
public:
  void push(double force)
  {
    m_pieces.push_back(m_now);
    const double h = 1. / commands;
    m_now = {m_now.p + h * (m_now.v + 0.5 * h * force), m_now.v + h * force, force};
    m_pieces.back().a = force;
  }
  [[nodiscard]] double at(double time) const
  {
    if (time <= 0.) {
      return 0.;
    }
    const std::size_t i = std::min(static_cast<std::size_t>(time * commands), m_pieces.size() - 1);
    const double t = time - static_cast<double>(i) / commands;
    return m_pieces[i].p + t * (m_pieces[i].v + 0.5 * t * m_pieces[i].a);
  }

private:
  struct Piece {
    double p = 0., v = 0., a = 0.;
  };
  std::vector<Piece> m_pieces;
  Piece m_now;
};

std::vector<vpPatternCell> cellsAt(const vpPrintMachineSpec &spec, double x, double y, int firstRow, int firstColumn)
{
  std::vector<vpPatternCell> cells;
  for (int row = firstRow; row < firstRow + spec.rows; ++row) {
    for (int k = 0; k < spec.cellsPerRow; ++k) {
      vpPatternCell cell;
      cell.row = row;
      cell.column = firstColumn - k;
      cell.x = spec.originX - k * spec.pitchX + x;
      cell.y = spec.nozzleAcross + (row - firstRow) * spec.pitchY + y;
      cell.sigmaX = cell.sigmaY = 0.02;
      cell.valid = true;
      if (cell.x > 0. && cell.x < 160. && cell.y > 0. && cell.y < 100.) {
        cells.push_back(cell);
      }
    }
  }
  return cells;
}
} // namespace

TEST_CASE("Each cell of rows to and fro gets one drop in its centre, whatever its number", "[printing]")
{
  vpPrintMachineSpec spec = idealSpec();
  spec.rows = 3;
  spec.cellsPerRow = 6;
  spec.originX = spec.nozzle - spec.pitchX; // a distance to accelerate
  vpPrintMachine machine(spec);
  for (const auto &[firstRow, firstColumn] : {std::pair<int, int>{0, -1}, {7, 40}}) {
    machine.reset(firstRow, firstColumn);
    Mass x, y;
    std::map<std::pair<int, int>, int> drops;
    std::vector<vpPrintShot> shots;
    for (int frame = 0; frame < 400; ++frame) {
      const double capture = frame - spec.visionDelay;
      const auto cells = cellsAt(spec, x.at(capture), y.at(capture), firstRow, firstColumn);
      const unsigned long before = vpTestSupport::allocationCount();
      const vpPrintMachineOutput &out = machine.step({static_cast<double>(frame), cells.data(), cells.size(), 1});
      CHECK(vpTestSupport::allocationCount() == before);
      REQUIRE(out.commandCount == commands);
      shots.insert(shots.end(), out.trigger->shots.begin(), out.trigger->shots.begin() + out.trigger->shotCount);
      for (std::size_t i = 0; i < commands; ++i) {
        x.push(out.forceX[i]);
        y.push(out.forceY[i]);
      }
    }
    for (const vpPrintShot &shot : shots) {
      ++drops[{shot.row, shot.column}];
      const double land = shot.fireTime + spec.travelTime;
      const double cellX = spec.originX - (firstColumn - shot.column) * spec.pitchX + x.at(land);
      const double cellY = spec.nozzleAcross + (shot.row - firstRow) * spec.pitchY + y.at(land);
      INFO("row " << shot.row << ", column " << shot.column);
      CHECK(std::abs(cellX - spec.nozzle) < 0.02);
      CHECK(std::abs(cellY - spec.nozzleAcross) < 0.02);
    }
    CHECK(drops.size() == static_cast<std::size_t>(spec.rows * spec.cellsPerRow));
    CHECK(shots.size() == drops.size());
  }
}

TEST_CASE("Wild cells and times leave the commands of a print machine finite", "[printing]")
{
  std::mt19937_64 rng(Catch::rngSeed());
  const vpPrintMachineSpec spec = idealSpec();
  for (int sequence = 0; sequence < 200; ++sequence) {
    vpPrintMachine machine(spec);
    for (int frame = 0; frame < 60; ++frame) {
      std::vector<vpPatternCell> cells = cellsAt(spec, 4. * frame, 0., 0, -1);
      for (vpPatternCell &cell : cells) {
        for (double *number : {&cell.x, &cell.y, &cell.sigmaX, &cell.sigmaY}) {
          *number = vpWildNumbers::mixed(rng, *number, 0.1);
        }
      }
      const vpPrintMachineOutput &out =
          machine.step({vpWildNumbers::mixed(rng, frame, 0.1), cells.data(), cells.size(), 1});
      for (std::size_t i = 0; i < commands; ++i) {
        REQUIRE(std::isfinite(out.forceX[i]));
        REQUIRE(std::isfinite(out.forceY[i]));
      }
      REQUIRE(std::isfinite(out.measuredVelocity));
      REQUIRE(std::isfinite(out.estimatedVelocity));
    }
  }
}

TEST_CASE("A print machine names what is out of range", "[printing]")
{
  const std::pair<std::function<void(vpPrintMachineSpec &)>, const char *> cases[] = {
      {[](auto &s) { s.pitchX = 0.; }, "pitchX of the print machine is 0, must be > 0"},
      {[](auto &s) { s.nozzle = NAN; }, "nozzle of the print machine is nan, must be finite"},
      {[](auto &s) { s.sigmaY = -1.; }, "sigmaY of the print machine is -1, must be > 0"},
      {[](auto &s) { s.cellsPerRow = 0; }, "cellsPerRow of the print machine is 0, must be 1..10000"},
      {[](auto &s) { s.travelTime = -1.; }, "travelTime"}};
  for (const auto &[spoil, sentence] : cases) {
    vpPrintMachineSpec spec;
    spoil(spec);
    CHECK_THROWS_WITH(vpPrintMachine(spec), Catch::Contains(sentence));
  }
}
