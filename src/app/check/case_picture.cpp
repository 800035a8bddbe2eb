#include "app/check/case_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "config/geometry.hpp"
#include "picture/plot.hpp"
#include "problem/shape.hpp"

namespace recoil::app {

namespace {

constexpr int pixels_along = 600;  // samples along the longer side
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Of a case in space: the plane of symmetry across z, or the middle [m].
double shown_plane(const config::Domain& domain) {
  for (const std::size_t side : {0, 1})
    if (domain.boundary[2][side] == config::Boundary::symmetry)
      return side == 0 ? domain.lo[2] : domain.hi[2];
  return 0.5 * (domain.lo[2] + domain.hi[2]);
}

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
        if constexpr (Dim > 2) x[2] = shown_plane(c.domain);
        const auto at = static_cast<std::size_t>(k);
        phi.values[at] = distance(x);
        if (phi.values[at] < 0) picture.values[at] = static_cast<double>(m + 1);
      }
    for (Outline& o : zero_outlines(phi)) picture.outlines.push_back(std::move(o));
  }
  return picture;
}

}  // namespace

void draw_case(const config::Case& c, const std::filesystem::path& file) {
  const PictureFormat format = picture_format(file);
  const int dim = config::dimension(c.domain.geometry);
  FieldPicture picture = dim == 1 ? sample<1>(c) : dim == 2 ? sample<2>(c) : sample<3>(c);
  const auto axes = config::axes_of(c.domain.geometry);
  picture.title = c.title;
  picture.note = dim == 3 ? fmt::format("z = {:.4g} mm", 1e3 * shown_plane(c.domain)) : "at the start";
  for (std::size_t m = 0; m < c.bodies.size(); ++m)
    picture.categories.push_back({static_cast<double>(m + 1), c.bodies[m].name, area_colour(m)});
  picture.detail = format == PictureFormat::png ? 1 : 2;
  picture.mirror = c.domain.geometry == config::Geometry::axisymmetric;
  picture.x_title = axes[0] + " [mm]";
  picture.y_title = dim > 1 ? axes[1] + " [mm]" : "";
  picture.y_labels = dim > 1;
  write_picture(file, field_picture(picture));
}

}  // namespace recoil::app
