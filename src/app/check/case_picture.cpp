#include "app/check/case_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "app/check/case_marks.hpp"
#include "app/check/case_view.hpp"
#include "app/plot/space_plotter.hpp"
#include "config/geometry.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"
#include "picture/plot.hpp"
#include "problem/shape.hpp"

namespace recoil::app {

namespace {

constexpr int pixels_along = 600;  // samples along the longer side

/// Number of the body at each sample, from 1; and all outlines.
template <int Dim>
FieldPicture sample(const config::Case& c) {
  const config::Vector &lo = c.domain.lo, &hi = c.domain.hi;
  const double width = hi[0] - lo[0], height = Dim > 1 ? hi[1] - lo[1] : 0.1 * width;
  FieldPicture picture;
  picture.dx = picture.dy = std::max(width, height) / pixels_along;
  picture.x0 = lo[0];
  picture.y0 = Dim > 1 ? lo[1] : 0;
  picture.nx = std::max(4, static_cast<int>(width / picture.dx));
  picture.ny = std::max(4, static_cast<int>(height / picture.dy));
  const auto n = static_cast<std::size_t>(picture.nx) * static_cast<std::size_t>(picture.ny);
  picture.values.assign(n, nothing);
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    const auto distance = signed_distance<Dim>(c.bodies[m].shape, c.domain);
    PlaneArray phi{
        picture.nx, picture.ny, picture.x0, picture.y0, picture.dx, picture.dy, std::vector<double>(n)};
    for (int j = 0, k = 0; j < picture.ny; ++j)
      for (int i = 0; i < picture.nx; ++i, ++k) {
        Vec<Dim> x;
        x[0] = picture.x0 + (i + 0.5) * picture.dx;
        if constexpr (Dim > 1) x[1] = picture.y0 + (j + 0.5) * picture.dy;
        const auto at = static_cast<std::size_t>(k);
        phi.values[at] = distance(x);
        if (phi.values[at] < 0) picture.values[at] = static_cast<double>(m + 1);
      }
    for (Outline& o : zero_outlines(phi)) picture.outlines.push_back(std::move(o));
  }
  return picture;
}

/// Where the arrow of a body starts: the middle of its samples, on the axis where there is one.
Point2 middle_of(const FieldPicture& p, std::size_t body) {
  Point2 sum;
  int count = 0;
  for (int j = 0, k = 0; j < p.ny; ++j)
    for (int i = 0; i < p.nx; ++i, ++k)
      if (p.values[static_cast<std::size_t>(k)] == static_cast<double>(body + 1)) {
        sum.x += p.x0 + (i + 0.5) * p.dx, sum.y += p.y0 + (j + 0.5) * p.dy;
        ++count;
      }
  if (count == 0) return {p.x0 + 0.5 * p.nx * p.dx, p.y0 + 0.5 * p.ny * p.dy};
  return {p.mirror ? 0 : sum.x / count, sum.y / count};
}

/// The arrows of a body: one in its middle, or several where its velocity is that of formulas.
std::vector<StartArrow> arrows_of(const FieldPicture& p, const config::Case& c, const StartMotion& m,
                                  int dim) {
  if (!has_velocity_field(c, m)) {
    const Point2 middle = middle_of(p, m.body);
    return {{{middle.x, middle.y, 0}, m.velocity, m.label}};
  }
  std::vector<config::Vector> places;
  const auto of_body = [&](int i, int j) {
    const auto k = static_cast<std::size_t>(i) + static_cast<std::size_t>(p.nx) * static_cast<std::size_t>(j);
    return p.values[k] == static_cast<double>(m.body + 1) && (dim > 1 || j == p.ny / 2);
  };
  for (const auto& [i, j] : spread_inside(p.nx, p.ny, of_body))
    places.push_back({p.x0 + (i + 0.5) * p.dx, p.y0 + (j + 0.5) * p.dy, 0});
  return field_arrows(c, m, places);
}

void add_marks(FieldPicture& p, const config::Case& c, int dim) {
  const double middle = p.y0 + 0.5 * p.ny * p.dy;  // of the strip that stands for a line
  for (const StartMotion& m : start_motions(c))
    for (const StartArrow& arrow : arrows_of(p, c, m, dim))
      p.marks.push_back({.at = {arrow.at[0], arrow.at[1]},
                         .way = {arrow.velocity[0], dim > 1 ? arrow.velocity[1] : 0},
                         .label = arrow.label,
                         .arrow = true});
  for (const GaugePlace& g : gauge_places(c))
    p.marks.push_back({.at = {g.at[0], dim > 1 ? g.at[1] : middle}, .label = g.name});
}

Canvas plane_of_case(const config::Case& c, PictureFormat format) {
  const int dim = config::dimension(c.domain.geometry);
  FieldPicture picture = dim == 1 ? sample<1>(c) : sample<2>(c);
  const auto axes = config::axes_of(c.domain.geometry);
  picture.title = c.title;
  picture.note = "at the start";
  for (std::size_t m = 0; m < c.bodies.size(); ++m)
    if (!c.bodies[m].takes_up_fragments())
      picture.categories.push_back({static_cast<double>(m + 1), c.bodies[m].name, area_colour(m)});
  picture.detail = format == PictureFormat::png ? 1 : 2;
  picture.mirror = c.domain.geometry == config::Geometry::axisymmetric;
  picture.x_title = axes[0] + " [mm]";
  picture.y_title = dim > 1 ? axes[1] + " [mm]" : "";
  picture.y_labels = dim > 1;
  add_marks(picture, c, dim);
  return field_picture(picture);
}

}  // namespace

std::string draw_case(const config::Case& c, const CasePictureOptions& o) {
  const PictureFormat format = picture_format(o.file);
  if (c.domain.geometry != config::Geometry::space) {
    if (!(o.view.empty() && o.up.empty() && o.cut.empty()))
      throw InputError("--view, --up and --cut need a 3d case\n   = help: omit them");
    write_picture(o.file, plane_of_case(c, format));
    return "";
  }
  CaseView v;
  if (o.view.empty()) {
    v = view_of_all_bodies(c, o.up, o.cut);
  } else {
    v.view = read_view(o.view, o.up);
    if (!o.cut.empty()) v.cut = read_cut(o.cut, v.view);
  }
  write_picture(o.file, view_of_case(c, v));
  return v.text;
}

}  // namespace recoil::app
