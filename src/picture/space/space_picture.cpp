#include "picture/space/space_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "picture/frame.hpp"
#include "picture/marks.hpp"
#include "picture/space/shading.hpp"
#include "picture/text.hpp"

namespace recoil {

namespace {

constexpr double left = 28, key_room = 150, band = 96;  // pixels; the band below has the axes and the scale

double top_of(const SpacePicture& p) { return p.title.empty() && p.note.empty() ? 24 : 62; }

/// Ends of the frame's projection on a direction [m].
std::array<double, 2> extent(const SpaceBox& box, const Vec<3>& along) {
  std::array<double, 2> ends{0, 0};
  for (int d = 0; d < 3; ++d) {
    const double a = along[d] * box.lo[d], b = along[d] * box.hi[d];
    ends[0] += std::min(a, b), ends[1] += std::max(a, b);
  }
  return ends;
}

void draw_arrow(Canvas& canvas, Point2 from, Point2 to, Rgb colour, double width) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length < 1) return;
  const double ux = (to.x - from.x) / length, uy = (to.y - from.y) / length;
  const double head = std::min(4.5 * width, 0.6 * length);
  const Point2 neck{to.x - head * ux, to.y - head * uy};
  draw_polyline(canvas, {from, neck}, {.colour = colour, .width = width}, canvas.bounds());
  fill_polygon(canvas,
               {to,
                {neck.x - 0.45 * head * uy, neck.y + 0.45 * head * ux},
                {neck.x + 0.45 * head * uy, neck.y - 0.45 * head * ux}},
               colour);
}

/// The three axes as they lie in the view.
void draw_axes_of(Canvas& canvas, const View& view, Point2 middle) {
  constexpr double size = 34;
  constexpr Rgb colours[] = {{200, 48, 44}, {34, 132, 68}, {30, 84, 180}};
  std::array<int, 3> order{0, 1, 2};  // those towards the viewer last
  std::ranges::sort(order, [&](int a, int b) { return view.forward[a] > view.forward[b]; });
  for (const int d : order) {
    const Point2 tip{middle.x + size * view.right[d], middle.y - size * view.up[d]};
    draw_arrow(canvas, middle, tip, colours[d], 2.6);
    const double away = std::hypot(view.right[d], view.up[d]);
    const double more = away < 0.2 ? 0 : 13 / away;
    draw_text(canvas, {tip.x + more * view.right[d], tip.y - more * view.up[d]}, std::string(1, "xyz"[d]),
              {.size = 17,
               .colour = colours[d],
               .horizontal = HorizontalAnchor::centre,
               .vertical = VerticalAnchor::middle,
               .bold = true});
  }
}

/// A bar of 1, 2 or 5 times a power of ten of a millimetre.
void draw_scale(Canvas& canvas, double pixels_per_m, const PixelRect& area) {
  const double most = 0.3 * (area.x1 - area.x0) / pixels_per_m * 1e3;
  double length = std::pow(10, std::floor(std::log10(most)));
  for (const double n : {5.0, 2.0})
    if (n * length <= most) {
      length *= n;
      break;
    }
  const double size = length * 1e-3 * pixels_per_m, x1 = area.x1 - 8, y = area.y1 + band - 30;
  fill_rect(canvas, {x1 - size, y - 2, x1, y + 2}, kPictureStyle.ink);
  for (const double x : {x1 - size, x1}) fill_rect(canvas, {x - 1, y - 7, x + 1, y + 7}, kPictureStyle.ink);
  draw_text(canvas, {x1 - 0.5 * size, y - 14}, fmt::format("{:g} mm", length),
            {.size = kPictureStyle.text,
             .colour = kPictureStyle.ink,
             .horizontal = HorizontalAnchor::centre,
             .vertical = VerticalAnchor::baseline});
}

/// What the heading needs of the width, where its title is small: narrow views get room beside them.
double heading_width(const SpacePicture& p) {
  if (p.title.empty() && p.note.empty()) return 0;
  return std::min(p.max_width - left - 24.0,
                  text_width(p.title, 14, true) + 24 + text_width(p.note, kPictureStyle.text));
}

/// Where the marks lie in the picture, and which of them have matter before them.
std::vector<Mark> placed_marks(const SpacePicture& p, const SpaceRays& rays, const PixelRect& area) {
  double fastest = 0;
  for (const SpaceMark& m : p.marks) fastest = std::max(fastest, norm(m.way));
  const double scale = fastest > 0 ? kLongestArrow / fastest : 0;
  const Screen& s = rays.screen;
  std::vector<Mark> marks;
  for (const SpaceMark& m : p.marks) {
    const Vec<3> way = m.at - s.corner;
    const double x = dot(way, p.view.right) / s.pixel, y = -dot(way, p.view.up) / s.pixel;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    bool behind = false;
    if (i >= 0 && j >= 0 && i < s.nx && j < s.ny) {
      const Hit& hit = rays.hits[static_cast<std::size_t>(i) +
                                 static_cast<std::size_t>(s.nx) * static_cast<std::size_t>(j)];
      behind = hit.any() && dot(way, p.view.forward) > hit.depth + 2 * rays.cell;
    }
    marks.push_back({{area.x0 + 0.5 * x, area.y0 + 0.5 * y},
                     {scale * dot(m.way, p.view.right), -scale * dot(m.way, p.view.up)},
                     m.label,
                     m.arrow,
                     behind});
  }
  return marks;
}

}  // namespace

std::vector<double> SpaceRays::values() const {
  std::vector<double> all;
  for (const Hit& hit : hits)
    if (!std::isnan(hit.value)) all.push_back(hit.value);
  return all;
}

ViewWindow joined(const ViewWindow& a, const ViewWindow& b) {
  return {std::min(a.x0, b.x0), std::max(a.x1, b.x1), std::min(a.y0, b.y0), std::max(a.y1, b.y1),
          std::min(a.nearest, b.nearest)};
}

std::optional<ViewWindow> window_of(const Scene& scene, const View& view,
                                    const std::optional<SpacePlane>& cut) {
  const SpaceBox box = scene.box();
  const auto across = extent(box, view.right), upwards = extent(box, view.up);
  constexpr int along = 240;  // rays along the longer side
  const double pixel = std::max(across[1] - across[0], upwards[1] - upwards[0]) / along;
  const double nearest = extent(box, view.forward)[0] - pixel;
  const auto even = [pixel](const std::array<double, 2>& ends) {
    return 2 * (static_cast<int>(0.5 * (ends[1] - ends[0]) / pixel) + 1);
  };
  const Screen screen{even(across), even(upwards), pixel,
                      view.right * across[0] + view.up * upwards[1] + view.forward * nearest};
  const std::vector<Hit> hits = cast_rays(scene, view, screen, cut);
  std::optional<ViewWindow> seen;
  for (int j = 0; j < screen.ny; ++j)
    for (int i = 0; i < screen.nx; ++i) {
      if (!hits[static_cast<std::size_t>(i) +
                static_cast<std::size_t>(screen.nx) * static_cast<std::size_t>(j)]
               .any())
        continue;
      // Between this ray and the next the body goes on.
      const double x = across[0] + (i + 0.5) * pixel, y = upwards[1] - (j + 0.5) * pixel;
      const ViewWindow own{x - 2 * pixel, x + 2 * pixel, y - 2 * pixel, y + 2 * pixel, nearest};
      seen = seen ? joined(*seen, own) : own;
    }
  return seen;
}

SpaceRays rays_of(const SpacePicture& p, const Scene& scene) {
  const double room_x = std::max(100.0, p.max_width - left - key_room),
               room_y = std::max(100.0, p.max_height - top_of(p) - band);
  const ViewWindow& w = p.window;
  const double pixel = std::max((w.x1 - w.x0) / room_x, (w.y1 - w.y0) / room_y);
  const int nx = std::max(240, static_cast<int>(std::lround((w.x1 - w.x0) / pixel)));
  const int ny = std::max(100, static_cast<int>(std::lround((w.y1 - w.y0) / pixel)));
  SpaceRays rays;
  rays.screen = {2 * nx, 2 * ny, 0.5 * pixel,
                 p.view.right * (0.5 * (w.x0 + w.x1) - 0.5 * nx * pixel) +
                     p.view.up * (0.5 * (w.y0 + w.y1) + 0.5 * ny * pixel) + p.view.forward * w.nearest};
  rays.hits = cast_rays(scene, p.view, rays.screen, p.cut);
  rays.cell = scene.cell();
  return rays;
}

Canvas space_picture(const SpacePicture& p, const SpaceRays& rays, const Colours& colours) {
  const Image image = shaded(rays, p.view, colours, rays.cell);
  const ColourKey key{colours, p.label, false};
  const PixelRect area{left, top_of(p), left + image.width, top_of(p) + image.height};
  const double heading = std::max(area.x1, left + heading_width(p));
  Canvas canvas(static_cast<int>(std::ceil(std::max(area.x1 + key_width(key), heading + 24))),
                static_cast<int>(area.y1 + band), kPictureStyle.page);
  draw_image(canvas, image, area);
  const double inset = std::min(40.0, 0.1 * (area.y1 - area.y0));
  draw_key(canvas, key, {area.x0, area.y0 + inset, area.x1, area.y1 - inset}, 0);
  draw_axes_of(canvas, p.view, {area.x0 + 44, area.y1 + band - 46});
  draw_scale(canvas, 0.5 / rays.screen.pixel, area);
  draw_marks(canvas, placed_marks(p, rays, area), canvas.bounds());
  draw_heading(canvas, {area.x0, area.y0, heading, area.y1}, p.title, p.note);
  return canvas;
}

}  // namespace recoil
