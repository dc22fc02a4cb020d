/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "armPicture.h"

#include "armCanvas.h"
#include "htmlReport.h"
#include "numberText.h"

namespace vpApp
{
namespace
{
constexpr const char *SOLID = "fill=\"#e0a458\" fill-opacity=\"0.45\" stroke=\"#a8641a\" stroke-width=\"1\"";
constexpr const char *FAINT =
    "fill=\"#e0a458\" fill-opacity=\"0.12\" stroke=\"#a8641a\" stroke-width=\"1\" stroke-dasharray=\"4 3\"";
constexpr const char *MOVING = "fill=\"#d1495b\" fill-opacity=\"0.45\" stroke=\"#8c1c2f\" stroke-width=\"1\"";

// Shows frame k of data: coordinates of the lines and dots, shifts of the objects, captions.
constexpr const char *SCRIPT = R"js(
(function (id, d) {
  var root = document.getElementById(id), slider = root.querySelector('input'), button = root.querySelector('button');
  var lines = root.querySelectorAll('line[data-arm]'), dots = root.querySelectorAll('circle[data-arm]');
  var objects = root.querySelectorAll('polygon[data-object]'), caption = root.querySelector('output');
  var playing = false, began = 0, from = 0;
  function show(k) {
    var f = d.frames[k], i;
    for (i = 0; i < lines.length; ++i) {
      ['x1', 'y1', 'x2', 'y2'].forEach(function (a, j) { lines[i].setAttribute(a, f.l[4 * i + j]); });
    }
    for (i = 0; i < dots.length; ++i) {
      dots[i].setAttribute('cx', f.c[2 * i]); dots[i].setAttribute('cy', f.c[2 * i + 1]);
    }
    for (i = 0; i < objects.length; ++i) {
      objects[i].setAttribute('transform', 'translate(' + f.o[3 * i] + ',' + f.o[3 * i + 1] + ')');
      objects[i].setAttribute('visibility', f.o[3 * i + 2] ? 'visible' : 'hidden');
    }
    caption.textContent = f.t.toFixed(2) + ' s  ' + f.s;
    slider.value = k;
  }
  function tick(now) {
    if (!playing) { return; }
    var t = from + (now - began) / 1000, k = +slider.value;
    while (k + 1 < d.frames.length && d.frames[k + 1].t <= t) { ++k; }
    show(k);
    if (k + 1 < d.frames.length) { requestAnimationFrame(tick); } else { stop(); }
  }
  function stop() { playing = false; button.textContent = 'Play'; }
  button.addEventListener('click', function () {
    if (playing) { stop(); return; }
    if (+slider.value + 1 >= d.frames.length) { show(0); }
    playing = true; button.textContent = 'Pause'; began = performance.now(); from = d.frames[+slider.value].t;
    requestAnimationFrame(tick);
  });
  slider.addEventListener('input', function () { stop(); show(+slider.value); });
  show(0);
}))js";

//! Extend the views to traces and marks.
void showLabelled(ArmCanvas &canvas, const std::vector<ArmTrace> &traces, const std::vector<ArmMark> &marks)
{
  for (const ArmTrace &trace : traces) {
    for (const Eigen::Vector3d &p : trace.points) {
      canvas.show(p);
    }
  }
  for (const ArmMark &mark : marks) {
    canvas.show(mark.place);
  }
}

//! Traces with their legend, and marks.
void drawLabelled(ArmCanvas &canvas, const std::vector<ArmTrace> &traces, const std::vector<ArmMark> &marks)
{
  for (const ArmTrace &trace : traces) {
    canvas.trace(trace);
  }
  for (const ArmMark &mark : marks) {
    canvas.mark(mark);
  }
  canvas.legend(traces);
}

void append(std::string &list, const Eigen::Vector2d &p)
{
  list += (list.empty() ? "" : ",") + px(p.x()) + "," + px(p.y());
}

//! Text as a JavaScript string, safe inside a script element.
std::string quoted(const std::string &text)
{
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\' || c == '<' || static_cast<unsigned char>(c) < 0x20) {
      constexpr const char *digits = "0123456789abcdef";
      const auto code = static_cast<unsigned char>(c);
      result += std::string("\\x") + digits[code >> 4] + digits[code & 15];
    }
    else {
      result += c;
    }
  }
  return result + "\"";
}

std::string frameData(const ArmCanvas &canvas, const vpArmModel &arm, const ArmAnimation &animation,
                      const ArmFrame &frame)
{
  const PlacedArm placed = placeArm(arm, frame.q);
  std::string lines, dots, objects;
  for (const ArmView view : canvas.views) {
    for (const vpPlacedCapsule &c : placed.capsules) {
      append(lines, canvas.pixel(c.from, view));
      append(lines, canvas.pixel(c.to, view));
    }
    append(lines, canvas.pixel(placed.capsules.empty() ? placed.tool : placed.capsules.back().to, view));
    append(lines, canvas.pixel(placed.tool, view));
    append(dots, canvas.pixel(placed.tool, view));
  }
  for (std::size_t i = 0; i < animation.objects.size(); ++i) {
    const Eigen::Vector3d place = animation.objects[i].pose.p;
    for (const ArmView view : canvas.views) {
      const Eigen::Vector2d shift = canvas.pixel(frame.objects[i].p, view) - canvas.pixel(place, view);
      const std::size_t count = outline(animation.objects[i], view).size();
      for (std::size_t k = 0; k < count; ++k) {
        append(objects, shift);
        objects += frame.visible.empty() || frame.visible[i] ? ",1" : ",0";
      }
    }
  }
  return "{t:" + fixed(frame.time, 3) + ",l:[" + lines + "],c:[" + dots + "],o:[" + objects +
         "],s:" + quoted(frame.caption) + "}";
}

//! The arm moved by the script, with its true width.
void drawArm(ArmCanvas &canvas, const vpArmModel &arm, const vpJointVector &q)
{
  const PlacedArm placed = placeArm(arm, q);
  for (std::size_t view = 0; view < 2; ++view) {
    canvas.add("<g stroke=\"#44546a\" fill=\"#44546a\" opacity=\"0.9\" stroke-linecap=\"round\">\n");
    for (const vpPlacedCapsule &c : placed.capsules) {
      canvas.add("<line data-arm=\"\" stroke-width=\"" + px(2. * c.radius * canvas.scale()) + "\"/>\n");
    }
    canvas.add("<line data-arm=\"\" stroke-width=\"3\"/><circle data-arm=\"\" r=\"4\"/></g>\n");
  }
}

ArmCanvas layOut(const vpArmModel &arm, const ArmAnimation &animation, const std::string &id)
{
  ArmCanvas canvas(arm, id + "view");
  for (const vpCollisionObject &object : animation.still) {
    canvas.show(object);
  }
  for (const ArmFrame &frame : animation.frames) {
    canvas.show(frame.q);
  }
  for (const vpCollisionObject &object : animation.objects) {
    if (object.velocity.linearNorm() == 0.) { // moving objects come from far away
      canvas.show(object);
    }
  }
  showLabelled(canvas, animation.traces, animation.marks);
  canvas.layOut();
  return canvas;
}
} // namespace

std::string armPictureSvg(const vpArmModel &arm, const ArmPicture &picture)
{
  ArmCanvas canvas(arm, "view", picture.views);
  for (const std::vector<vpCollisionObject> *list : {&picture.objects, &picture.faint}) {
    for (const vpCollisionObject &object : *list) {
      canvas.show(object);
    }
  }
  for (const ArmGhost &ghost : picture.ghosts) {
    canvas.show(ghost.q);
  }
  for (const ArmPart &part : picture.parts) {
    canvas.show(part.object);
  }
  showLabelled(canvas, picture.traces, picture.marks);
  canvas.layOut();

  canvas.heading(picture.title, picture.ground);
  for (const vpCollisionObject &object : picture.faint) {
    canvas.object(object, FAINT);
  }
  canvas.parts(picture.parts);
  for (const ArmGhost &ghost : picture.ghosts) {
    canvas.ghost(ghost);
  }
  for (const vpCollisionObject &object : picture.objects) {
    canvas.object(object, SOLID);
  }
  drawLabelled(canvas, picture.traces, picture.marks);
  return canvas.svg();
}

std::string armAnimationHtml(const vpArmModel &arm, const ArmAnimation &animation, const std::string &id)
{
  ArmCanvas canvas = layOut(arm, animation, id);
  canvas.heading(animation.title, animation.ground);
  for (const vpCollisionObject &object : animation.still) {
    canvas.object(object, SOLID);
  }
  drawArm(canvas, arm, animation.frames.front().q);
  for (const vpCollisionObject &object : animation.objects) {
    canvas.object(object, std::string("data-object=\"\" ") + MOVING);
  }
  drawLabelled(canvas, animation.traces, animation.marks);
  std::string frames;
  for (const ArmFrame &frame : animation.frames) {
    frames += (frames.empty() ? "" : ",\n") + frameData(canvas, arm, animation, frame);
  }
  const std::string last = std::to_string(animation.frames.size() - 1);
  return "<figure id=\"" + escapeHtml(id) + "\">\n" + canvas.svg("style=\"width:100%;height:auto\"") +
         "<div><button type=\"button\">Play</button> <input type=\"range\" min=\"0\" max=\"" + last +
         "\" value=\"0\" style=\"width:60%;vertical-align:middle\" aria-label=\"time\"> <output></output></div>\n" +
         "</figure>\n<script>" + SCRIPT + "(" + quoted(id) + ", {frames:[" + frames + "]});</script>\n";
}
} // namespace vpApp
