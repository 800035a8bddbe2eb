#include "app/plot/rigid_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "problem/rigid_start.hpp"
#include "problem/start.hpp"
#include "state/rigid_motion.hpp"

namespace recoil::app {

namespace {

/// Distance to a box from outside, 0 inside.
double outside_of(const SpaceBox& box, const Vec<3>& x) {
  Vec<3> away{};
  for (int d = 0; d < 3; ++d) away[d] = std::max({box.lo[d] - x[d], x[d] - box.hi[d], 0.0});
  return norm(away);
}

std::function<double(const Vec<3>&)> distance_in(RigidMotion<3> motion, const RigidPose<3>& pose) {
  return [motion = std::move(motion), pose](const Vec<3>& x) { return distance_at(motion, pose, x); };
}

}  // namespace

RigidScene::RigidScene(const Scene& scene, int bodies, const config::Case& c, double time,
                       const std::vector<RigidPlace>& places, const std::vector<std::string>& shown)
    : scene_(scene), bodies_(bodies), box_(scene.box()) {
  const Grid<3> grid = make_grid<3>(c);
  for (std::size_t m = 0; m < c.bodies.size(); ++m) {
    const config::Body& body = c.bodies[m];
    if (!body.rigid || (!shown.empty() && std::ranges::find(shown, body.name) == shown.end())) continue;
    RigidMotion<3> motion = prescribed_motion<3>(body, c, grid);
    const auto place = std::ranges::find(places, static_cast<int>(m), &RigidPlace::body);
    if (place != places.end()) {
      motion.start_centre = place->start_centre;
      rigid_.push_back(distance_in(std::move(motion), place->pose));
    } else if (body.mass == 0) {
      follow_history(motion, 0, time);
      const RigidPose<3> pose = pose_after(motion, time);
      rigid_.push_back(distance_in(std::move(motion), pose));
    }
  }
  if (!rigid_.empty())
    box_ = {config::first_components<3>(c.domain.lo), config::first_components<3>(c.domain.hi)};
}

/// A dump has empty cells around all matter but where it meets the edge of the domain: beyond its box nothing
/// is.
double RigidScene::distance_to_matter(const Vec<3>& x) const {
  const double away = outside_of(scene_.box(), x);
  return away > 0 ? away + 0.5 * scene_.cell() : scene_.distance(x);
}

double RigidScene::distance(const Vec<3>& x) const {
  double least = distance_to_matter(x);
  for (const auto& rigid : rigid_) least = std::min(least, rigid(x));
  return least;
}

int RigidScene::body(const Vec<3>& x) const {
  int best = -1;
  double least = distance_to_matter(x);
  for (std::size_t m = 0; m < rigid_.size(); ++m)
    if (const double d = rigid_[m](x); d < least) least = d, best = static_cast<int>(m);
  return best < 0 ? scene_.body(x) : bodies_ + best;
}

double RigidScene::value(const Vec<3>& x, int body) const {
  return body < bodies_ ? scene_.value(x, body) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace recoil::app
