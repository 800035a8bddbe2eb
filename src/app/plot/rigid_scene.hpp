#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "picture/space/scene.hpp"

namespace recoil::app {

/// Whether the case alone says where the body is at any time: it is rigid and has no mass. Bodies with a mass
/// move as their contacts have it, and a dump holds only their parts near deformable ones.
bool moves_as_prescribed(const config::Body& body);

/// The bodies of a dump with rigid bodies of the case, whose numbers follow; they have no field.
class RigidScene : public Scene {
 public:
  /// @param bodies how many the scene has. @param shown names of bodies to show; none: all.
  RigidScene(const Scene& scene, int bodies, const config::Case& c, double time,
             const std::vector<std::string>& shown);

  bool empty() const { return rigid_.empty(); }
  SpaceBox box() const override { return box_; }
  double cell() const override { return scene_.cell(); }
  double distance(const Vec<3>& x) const override;
  int body(const Vec<3>& x) const override;
  double value(const Vec<3>& x, int body) const override;

 private:
  double distance_to_matter(const Vec<3>& x) const;

  const Scene& scene_;
  int bodies_;
  SpaceBox box_;
  std::vector<std::function<double(const Vec<3>&)>> rigid_;
};

}  // namespace recoil::app
