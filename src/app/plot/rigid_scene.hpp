#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "picture/space/scene.hpp"
#include "record/rigid_places.hpp"

namespace recoil::app {

/// The bodies of a dump with rigid bodies, whose numbers follow; they have no field.
class RigidScene : public Scene {
 public:
  /// @param bodies how many the scene has. @param places of the rigid bodies, as the dump has them. Of a body
  /// without one, in runs of older versions, the case says where it is at that time [s] if it moves as
  /// prescribed; free ones are left out then. @param shown names of bodies to show; none: all.
  RigidScene(const Scene& scene, int bodies, const config::Case& c, double time,
             const std::vector<RigidPlace>& places, const std::vector<std::string>& shown);

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
