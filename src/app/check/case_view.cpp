#include "app/check/case_view.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "app/check/case_marks.hpp"
#include "app/plot/space_plotter.hpp"
#include "core/error.hpp"
#include "picture/space/space_picture.hpp"
#include "problem/shape.hpp"

namespace recoil::app {

namespace {

constexpr double enough = 0.5;  // of a body that is seen

/// The shapes of a case: they are exact, and known in all of the domain.
class CaseScene : public Scene {
 public:
  explicit CaseScene(const config::Case& c) : CaseScene(c, c.bodies) {}
  CaseScene(const config::Case& c, std::span<const config::Body> bodies) : cell_(0.1 * c.mesh.finest) {
    box_ = {config::first_components<3>(c.domain.lo), config::first_components<3>(c.domain.hi)};
    for (const config::Body& body : bodies) bodies_.push_back(signed_distance<3>(body.shape, c.domain));
  }

  SpaceBox box() const override { return box_; }
  double cell() const override { return cell_; }
  double distance(const Vec<3>& x) const override {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& body : bodies_) least = std::min(least, body(x));
    return least;
  }
  int body(const Vec<3>& x) const override {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < bodies_.size(); ++m)
      if (const double d = bodies_[m](x); d < least) least = d, best = m;
    return static_cast<int>(best);
  }
  double value(const Vec<3>& /*x*/, int body) const override { return body + 1; }

 private:
  SpaceBox box_;
  double cell_;  // edges of shapes are sharper than the mesh will have them
  std::vector<std::function<double(const Vec<3>&)>> bodies_;
};

/// The middle of what is seen of each body; bodies that are not seen have no number of rays.
struct Seen {
  Vec<3> sum{};
  int rays = 0;
};

const Hit& hit_at(const SpaceRays& rays, int i, int j) {
  return rays.hits[static_cast<std::size_t>(i) +
                   static_cast<std::size_t>(rays.screen.nx) * static_cast<std::size_t>(j)];
}

Vec<3> place_of_hit(const SpaceRays& rays, const View& view, int i, int j) {
  const Screen& s = rays.screen;
  return s.corner + view.right * ((i + 0.5) * s.pixel) - view.up * ((j + 0.5) * s.pixel) +
         view.forward * hit_at(rays, i, j).depth;
}

std::vector<Seen> seen_parts(const SpaceRays& rays, const View& view, std::size_t bodies) {
  std::vector<Seen> seen(bodies);
  const Screen& s = rays.screen;
  for (int j = 0; j < s.ny; ++j)
    for (int i = 0; i < s.nx; ++i) {
      const Hit& hit = hit_at(rays, i, j);
      if (!hit.any()) continue;
      Seen& its = seen[static_cast<std::size_t>(hit.body)];
      its.sum = its.sum + place_of_hit(rays, view, i, j);
      ++its.rays;
    }
  return seen;
}

/// How much is seen of the bodies: the sum of the seen parts of each, where a half is enough.
double how_much_is_seen(const config::Case& c, const CaseView& v) {
  constexpr int rays_across = 120;
  const CaseScene scene(c);
  const std::optional<ViewWindow> window = window_of(scene, v.view, v.cut);
  if (!window) return 0;
  const double width = window->x1 - window->x0, height = window->y1 - window->y0;
  Screen screen{rays_across, rays_across, std::max(width, height) / rays_across, {}};
  screen.corner = v.view.right * window->x0 + v.view.up * window->y1 + v.view.forward * window->nearest;
  const auto hits_of = [&](const Scene& bodies, std::size_t body) {
    return std::ranges::count_if(cast_rays(bodies, v.view, screen, v.cut), [&](const Hit& h) {
      return h.any() && static_cast<std::size_t>(h.body) == body;
    });
  };
  double sum = 0;
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    const auto alone = hits_of(CaseScene(c, std::span(c.bodies).subspan(m, 1)), 0);
    if (alone > 0)
      sum += std::min(enough, static_cast<double>(hits_of(scene, m)) / static_cast<double>(alone));
  }
  return sum;
}

/// Adds gauges and velocities; the note names bodies that are not seen.
/// Arrows on what is seen of a body whose velocity is that of formulas.
void add_field_marks(SpacePicture& p, const config::Case& c, const SpaceRays& rays,
                     const StartMotion& motion) {
  const auto of_body = [&](int i, int j) {
    const Hit& hit = hit_at(rays, i, j);
    return hit.any() && static_cast<std::size_t>(hit.body) == motion.body;
  };
  std::vector<config::Vector> places;
  for (const auto& [i, j] : spread_inside(rays.screen.nx, rays.screen.ny, of_body)) {
    const Vec<3> x = place_of_hit(rays, p.view, i, j);
    places.push_back({x[0], x[1], x[2]});
  }
  for (const StartArrow& arrow : field_arrows(c, motion, places))
    p.marks.push_back({config::first_components<3>(arrow.at), config::first_components<3>(arrow.velocity),
                       arrow.label, true});
}

void add_marks(SpacePicture& p, const config::Case& c, const SpaceRays& rays) {
  const std::vector<Seen> seen = seen_parts(rays, p.view, c.bodies.size());
  for (const StartMotion& motion : start_motions(c)) {
    const Seen& its = seen[motion.body];
    if (has_velocity_field(c, motion))
      add_field_marks(p, c, rays, motion);
    else if (its.rays > 0)
      p.marks.push_back(
          {its.sum * (1.0 / its.rays), config::first_components<3>(motion.velocity), motion.label, true});
  }
  std::string hidden;
  for (std::size_t m = 0; m < seen.size(); ++m)
    if (seen[m].rays == 0 && !c.bodies[m].takes_up_fragments())
      hidden += (hidden.empty() ? "; not seen: " : ", ") + c.bodies[m].name;
  p.note += hidden;
  for (const GaugePlace& g : gauge_places(c))
    p.marks.push_back({config::first_components<3>(g.at), {}, g.name});
}

}  // namespace

CaseView view_of_all_bodies(const config::Case& c, const std::string& up, const std::string& cut) {
  const auto seen_as = [&](const std::string& text) {
    CaseView v{text, read_view(text, up), {}};
    if (!cut.empty()) v.cut = read_cut(cut, v.view);
    return v;
  };
  CaseView best = seen_as("");
  const auto bodies = std::ranges::count_if(c.bodies, [](const auto& b) { return !b.takes_up_fragments(); });
  const double all = enough * static_cast<double>(bodies);
  double most = how_much_is_seen(c, best);
  for (const char* text : {"35deg,24deg", "125deg,24deg", "-145deg,24deg", "-55deg,-24deg", "35deg,-24deg",
                           "125deg,-24deg", "-145deg,-24deg"}) {
    if (most >= all) break;
    const CaseView v = seen_as(text);
    if (const double seen = how_much_is_seen(c, v); seen > most) best = v, most = seen;
  }
  return best;
}

Canvas view_of_case(const config::Case& c, const CaseView& v) {
  const CaseScene scene(c);
  SpacePicture p{.view = v.view, .cut = v.cut, .title = c.title, .note = "at the start"};
  const std::optional<ViewWindow> window = window_of(scene, v.view, v.cut);
  if (!window) throw InputError("nothing is left of the bodies\n   = help: another --cut");
  p.window = *window;
  const SpaceRays rays = rays_of(p, scene);
  add_marks(p, c, rays);
  ColourChoice choice;
  for (std::size_t m = 0; m < c.bodies.size(); ++m)
    if (!c.bodies[m].takes_up_fragments())
      choice.categories.push_back({static_cast<double>(m + 1), c.bodies[m].name, area_colour(m)});
  return space_picture(p, rays, colours_of(rays.values(), choice));
}

}  // namespace recoil::app
