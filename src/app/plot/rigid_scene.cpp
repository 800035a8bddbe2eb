#include "app/plot/rigid_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "problem/shape.hpp"
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

/// Its signed distance at a time [s].
std::function<double(const Vec<3>&)> distance_then(const config::Body& body, const config::Domain& domain,
                                                   double time) {
  auto motion = prescribed_motion<3>(body, signed_distance<3>(body.shape, domain));
  follow_history(motion, 0, time);
  return [motion, pose = pose_after(motion, time)](const Vec<3>& x) { return distance_at(motion, pose, x); };
}

}  // namespace

bool moves_as_prescribed(const config::Body& body) { return body.rigid && body.mass == 0; }

RigidScene::RigidScene(const Scene& scene, int bodies, const config::Case& c, double time,
                       const std::vector<std::string>& shown)
    : scene_(scene), bodies_(bodies), box_(scene.box()) {
  for (const config::Body& body : c.bodies) {
    if (!moves_as_prescribed(body) || (!shown.empty() && std::ranges::find(shown, body.name) == shown.end()))
      continue;
    rigid_.push_back(distance_then(body, c.domain, time));
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
