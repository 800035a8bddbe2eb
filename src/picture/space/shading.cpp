#include "picture/space/shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "picture/frame.hpp"

namespace recoil {

namespace {

using Linear = std::array<double, 3>;

double to_linear(unsigned char c) {
  const double v = c / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

unsigned char from_linear(double v) {
  const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255 * std::clamp(s, 0.0, 1.0)));
}

Linear to_linear(Rgb c) { return {to_linear(c.r), to_linear(c.g), to_linear(c.b)}; }

constexpr Rgb no_value{196, 200, 206};  // of matter without a state

class Shading {
 public:
  Shading(const SpaceRays& rays, const View& view, const Colours& colours, double cell)
      : rays_(rays), view_(view), colours_(colours), cell_(cell) {
    light_ = unit(view.up * 0.55 - view.right * 0.45 - view.forward * 0.75);
    half_ = unit(light_ - view.forward);
    edges_.assign(rays.hits.size(), 0);
    for (int j = 0; j + 1 < ny(); ++j)
      for (int i = 0; i + 1 < nx(); ++i)
        for (const auto& [a, b] : {std::array{1, 0}, std::array{0, 1}})
          if (const double dark = edge(at(i, j), at(i + a, j + b)); dark > 0) {
            for (const std::size_t k : {index(i, j), index(i + a, j + b)})
              edges_[k] = std::max(edges_[k], static_cast<float>(dark));
          }
  }

  Rgb pixel(int i, int j) const {
    Linear sum{};
    for (int k = 0; k < 4; ++k) {
      const Linear c = lit(2 * i + k % 2, 2 * j + k / 2);
      for (std::size_t d = 0; d < 3; ++d) sum[d] += 0.25 * c[d];
    }
    return {from_linear(sum[0]), from_linear(sum[1]), from_linear(sum[2])};
  }

 private:
  int nx() const { return rays_.screen.nx; }
  int ny() const { return rays_.screen.ny; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) + static_cast<std::size_t>(nx()) * static_cast<std::size_t>(j);
  }
  const Hit& at(int i, int j) const { return rays_.hits[index(i, j)]; }

  /// How dark the line between two neighbours is, 0: none.
  double edge(const Hit& p, const Hit& q) const {
    if (p.any() != q.any()) return 0.9;
    if (!p.any()) return 0;
    if (p.body != q.body) return 0.9;
    if (p.face != q.face) return 0.75;
    // On one smooth surface the depth changes by the slope of the steeper normal.
    const double slope = std::min(-dot(p.normal, view_.forward), -dot(q.normal, view_.forward));
    const double pixel = rays_.screen.pixel;
    if (std::abs(p.depth - q.depth) > std::max(1.5 * cell_, 6 * pixel / std::max(slope, 0.15))) return 0.75;
    return dot(p.normal, q.normal) < 0.72 ? 0.4 : 0;
  }

  /// Part of the light from all sides that reaches the place.
  double open(int i, int j) const {
    const Hit& hit = at(i, j);
    constexpr int directions = 12;
    const double reach = std::max(8.0, 0.035 * nx());
    double blocked = 0;
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * 3.14159265358979 * (k + 0.5) / directions, r = reach * (1 + k % 3) / 3;
      const int a = i + static_cast<int>(std::lround(r * std::cos(angle)));
      const int b = j + static_cast<int>(std::lround(r * std::sin(angle)));
      if (a < 0 || b < 0 || a >= nx() || b >= ny() || !at(a, b).any()) continue;
      const Hit& other = at(a, b);
      const Vec<3> way = view_.right * ((a - i) * rays_.screen.pixel) -
                         view_.up * ((b - j) * rays_.screen.pixel) +
                         view_.forward * (other.depth - hit.depth);
      const double size = norm(way), rise = dot(way, hit.normal) / std::max(size, 1e-30);
      const double range = reach * rays_.screen.pixel;
      if (size < 2.5 * range) blocked += std::clamp(1.3 * rise - 0.15, 0.0, 1.0);
    }
    return 1 - 0.75 * blocked / directions;
  }

  Linear lit(int i, int j) const {
    const Hit& hit = at(i, j);
    if (!hit.any()) {
      const double line = edges_[index(i, j)];
      return mixed(to_linear(kPictureStyle.page), line);
    }
    Linear c = to_linear(std::isnan(hit.value) ? no_value : colours_.at(hit.value));
    if (!hit.face) {
      const double facing = std::max(0.0, dot(hit.normal, light_)), head = -dot(hit.normal, view_.forward);
      const double light = (0.34 + 0.2 * head) * open(i, j) + 0.56 * facing;
      const double shine = 0.07 * std::pow(std::max(0.0, dot(hit.normal, half_)), 40);
      for (double& v : c) v = v * light + shine;
    }
    return mixed(c, edges_[index(i, j)]);
  }

  static Linear mixed(Linear c, double dark) {
    const Linear ink = to_linear(Rgb{24, 26, 30});
    for (std::size_t d = 0; d < 3; ++d) c[d] += dark * (ink[d] - c[d]);
    return c;
  }

  const SpaceRays& rays_;
  const View& view_;
  const Colours& colours_;
  double cell_;
  Vec<3> light_, half_;
  std::vector<float> edges_;
};

}  // namespace

Image shaded(const SpaceRays& rays, const View& view, const Colours& colours, double cell) {
  const Shading shading(rays, view, colours, cell);
  Image image(rays.screen.nx / 2, rays.screen.ny / 2);
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i) image.set(i, j, shading.pixel(i, j));
  return image;
}

}  // namespace recoil
