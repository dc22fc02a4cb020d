/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "plot.h"
#include "outputFolder.h"
#include "timePlot.h"

#include "vpPrintable.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h> // environ

namespace vpApp
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t CURVE_POINTS = 800; // more would not be visible

//! A folder under the system's temporary folder, removed at the end.
class ScratchFolder
{
public:
  ScratchFolder()
  {
    const char *wanted = std::getenv("TMPDIR");
    const std::string folder = wanted != nullptr && *wanted != '\0' ? wanted : "/tmp";
    std::string name = (fs::path(folder) / "visp-direct-plot-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error(folder + ": is the folder for temporary files (TMPDIR) and cannot be written in (" +
                               std::generic_category().message(errno) + ")");
    }
    m_path = name;
  }
  ~ScratchFolder()
  {
    std::error_code ignored;
    fs::remove_all(m_path, ignored);
  }
  ScratchFolder(const ScratchFolder &) = delete;
  ScratchFolder &operator=(const ScratchFolder &) = delete;
  [[nodiscard]] std::string file(const std::string &name) const { return (m_path / name).string(); }

private:
  fs::path m_path;
};

// Returns gnuplot's exit status; its output and errors go to log.
int runGnuplot(const std::string &argument, const std::string &log)
{
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  std::string program = "gnuplot";
  std::string copy = argument;
  char *const arguments[] = {program.data(), copy.data(), nullptr};
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error != 0 || waitpid(pid, &status, 0) != pid || (WIFEXITED(status) && WEXITSTATUS(status) == 127)) {
    throw std::runtime_error(
        "gnuplot draws the plots of the report and was not found; install it (Debian: gnuplot-nox)");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string quoted(const std::string &text)
{
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? "''" : std::string(1, c == '\n' ? ' ' : c);
  }
  return result + "'";
}

// Text in the figure may come from files.
std::string quotedText(const std::string &text) { return quoted(vpEscapeUnprintable(text, "\n")); }

std::string range(const std::pair<double, double> &limits)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << '[';
  if (limits.first < limits.second) {
    text << limits.first << ':' << limits.second;
  }
  text << ']';
  return text.str();
}

// Tic spacing of a map: 1, 2 or 5 times a power of ten, about five tics over the width of the data.
double ticStep(const Plot &plot)
{
  double least = HUGE_VAL;
  double largest = -HUGE_VAL;
  for (const PlotCurve &curve : plot.curves) {
    for (const double x : curve.x) {
      if (std::isfinite(x)) {
        least = std::min(least, x);
        largest = std::max(largest, x);
      }
    }
  }
  const double wanted = std::max(largest - least, 1e-6) / 5.;
  const double power = std::pow(10., std::floor(std::log10(wanted)));
  for (const double factor : {1., 2., 5.}) {
    if (factor * power >= wanted) {
      return factor * power;
    }
  }
  return 10. * power;
}

std::string lineStyle(const PlotCurve &curve)
{
  const std::string colour = " linecolor rgb " + quoted(curve.colour);
  if (curve.style == PlotStyle::Points || curve.style == PlotStyle::Rings) {
    const std::string type = curve.style == PlotStyle::Points ? "7" : "6 linewidth 1.5";
    return "points pointtype " + type + " pointsize " + std::to_string(0.25 * curve.width) + colour;
  }
  std::string dash;
  if (curve.style == PlotStyle::Dashed) {
    dash = " dashtype (9,5)";
  }
  else if (curve.style == PlotStyle::Dotted) {
    dash = " dashtype (2,4)";
  }
  std::ostringstream width;
  width.imbue(std::locale::classic());
  width << curve.width;
  return "lines linewidth " + width.str() + dash + colour;
}

// Large numbers are written 1k, 10k, 100k.
void setLogarithmic(const Plot &plot, const char *axis, std::vector<double> PlotCurve::*values, std::ostream &script)
{
  double least = HUGE_VAL;
  for (const PlotCurve &curve : plot.curves) {
    for (const double value : curve.*values) {
      least = value > 0. ? std::min(least, value) : least;
    }
  }
  script << "set logscale " << axis << " 10\nset format " << axis << (least >= 10. ? " '%.0s%c'\n" : " '%g'\n");
}

//! The commands that draw one plot. \param id : Id of the plot in the figure.
void draw(const Plot &plot, std::size_t id, std::ostream &script)
{
  const std::string data = "$curve" + std::to_string(id) + "_";
  script << "set title " << quotedText(plot.title) << "\n"
         << "set xlabel " << quotedText(plot.xLabel) << "\nset ylabel " << quotedText(plot.yLabel) << "\n"
         << "set grid linecolor rgb '#dfe3e8'\nset border linecolor rgb '#555555'\n"
         << "set key outside right top vertical Left reverse samplen 2\n";
  if (plot.equalAxes) {
    script << "set size ratio -1\nset offsets graph 0.08, graph 0.08, graph 0.04, graph 0.04\n"
           << "set xtics " << ticStep(plot) << "\nset ytics " << ticStep(plot) << "\n";
  }
  else if (!plot.logY) { // room for the labels of the marks
    script << "set offsets 0, 0, graph 0.12, graph 0.04\n";
  }
  if (plot.logX) {
    setLogarithmic(plot, "x", &PlotCurve::x, script);
  }
  if (plot.logY) {
    setLogarithmic(plot, "y", &PlotCurve::y, script);
  }
  if (plot.fromZero) {
    script << "set yrange [0:*]\n";
  }
  if (!plot.categories.empty()) {
    script << "set xtics rotate by -35 (";
    for (std::size_t i = 0; i < plot.categories.size(); ++i) {
      script << (i == 0 ? "" : ", ") << quotedText(plot.categories[i]) << " " << i;
    }
    script << ")\n";
  }
  for (const PlotMark &mark : plot.marks) {
    script << "set arrow from " << mark.x << ", graph 0 to " << mark.x << ", graph 1 nohead back "
           << "linecolor rgb '#999999' dashtype (3,3)\n"
           << "set label " << quotedText(mark.label) << " at " << mark.x << ", graph 0.96 offset 0.6,0 front "
           << "textcolor rgb '#666666'\n";
  }
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PlotCurve &curve = plot.curves[i];
    script << data << i << " << EOD\n";
    bool gap = true;
    for (std::size_t k = 0; k < std::min(curve.x.size(), curve.y.size()); ++k) {
      const bool good = std::isfinite(curve.x[k]) && std::isfinite(curve.y[k]);
      if (good) {
        script << curve.x[k] << ' ' << curve.y[k] << '\n';
      }
      else if (!gap) {
        script << '\n'; // an empty line interrupts the curve
      }
      gap = !good;
    }
    script << "EOD\n";
  }
  script << "plot " << range(plot.xRange);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PlotCurve &curve = plot.curves[i];
    script << (i == 0 ? " " : ", \\\n  ") << data << i << " using 1:2 with " << lineStyle(curve)
           << (curve.label.empty() ? " notitle" : " title " + quotedText(curve.label));
  }
  script << "\n";
}

//! Width of a panel's legend in characters: as many columns as its height needs.
std::size_t legendWidth(const Plot &plot)
{
  constexpr unsigned int outside = 60, row = 19; // pixels: above and below the legend, and of one of its rows
  constexpr std::size_t sample = 5;              // characters beside a label
  const std::size_t rows = std::max(1U, plot.height > outside ? (plot.height - outside) / row : 1U);
  std::size_t longest = 0;
  for (const PlotCurve &curve : plot.curves) {
    longest = std::max(longest, curve.label.size());
  }
  return (plot.curves.size() + rows - 1) / rows * (longest + sample);
}

// The margins leave room for the legends and are the same in all panels.
std::string scriptOf(const std::vector<Plot> &panels, PlotFormat format, const std::string &output)
{
  unsigned int width = 0;
  unsigned int height = 0;
  std::size_t legend = 22;
  for (const Plot &plot : panels) {
    legend = std::max(legend, legendWidth(plot));
    width = std::max(width, plot.width);
    height += plot.height;
  }
  std::ostringstream script;
  script.imbue(std::locale::classic());
  script << "set encoding utf8\nset terminal "
         << (format == PlotFormat::Svg ? "svg dynamic noenhanced font 'DejaVu Sans,Helvetica,Arial,14'"
                                       : "pngcairo noenhanced font 'DejaVu Sans,11'")
         << " size " << width << "," << height << " background '#ffffff'\nset output " << quoted(output) << "\n";
  if (panels.size() > 1) {
    script << "set multiplot\n";
  }
  unsigned int below = height;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (panels.size() > 1) {
      below -= panels[i].height;
      script << "reset\nset origin 0, " << 1. * below / height << "\nset size 1, " << 1. * panels[i].height / height
             << "\nset lmargin 11\nset rmargin " << legend << "\n";
    }
    draw(panels[i], i, script);
  }
  return script.str();
}

std::string render(const std::vector<Plot> &panels, PlotFormat format)
{
  const ScratchFolder scratch;
  const std::string script = scratch.file("plot.gp");
  std::ofstream stream(script);
  stream << scriptOf(panels, format, scratch.file("plot"));
  stream.close();
  if (!stream) {
    throw std::runtime_error(script + ": cannot be written");
  }
  if (runGnuplot(script, scratch.file("log")) != 0) {
    throw std::runtime_error("gnuplot failed on the plot \"" + panels.front().title +
                             "\": " + readFile(scratch.file("log")));
  }
  return readFile(scratch.file("plot"));
}
} // namespace

void requireGnuplot()
{
  const ScratchFolder scratch;
  (void)runGnuplot("--version", scratch.file("log"));
}

std::string renderSvg(const Plot &plot) { return render({plot}, PlotFormat::Svg); }

std::string renderPanels(const std::vector<Plot> &panels, PlotFormat format)
{
  if (panels.empty()) {
    throw std::runtime_error("a picture needs at least one plot");
  }
  return render(panels, format);
}

PlotCurve timeCurve(const std::string &label, const std::string &colour, std::size_t count,
                    const std::function<double(std::size_t)> &time, const std::function<double(std::size_t)> &value,
                    Keep keep)
{
  PlotCurve curve;
  curve.label = label;
  curve.colour = colour;
  curve.width = 1.6;
  const std::size_t stride = std::max<std::size_t>(1, count / CURVE_POINTS);
  for (std::size_t i = 0; i < count; i += stride) {
    double shown = value(i);
    for (std::size_t k = i + 1; k < std::min(i + stride, count); ++k) {
      shown = keep == Keep::Least ? std::min(shown, value(k)) : std::max(shown, value(k));
    }
    curve.x.push_back(time(i));
    curve.y.push_back(shown);
  }
  return curve;
}

PlotCurve timeCurve(const std::string &label, const std::string &colour, const std::vector<double> &times,
                    const std::vector<double> &values, Keep keep)
{
  return timeCurve(
      label, colour, times.size(), [&](std::size_t i) { return times[i]; }, [&](std::size_t i) { return values[i]; },
      keep);
}
} // namespace vpApp
