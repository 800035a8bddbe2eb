#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "config/case.hpp"
#include "picture/canvas.hpp"
#include "picture/field_plane.hpp"
#include "picture/space/field_scene.hpp"
#include "picture/space/space_picture.hpp"
#include "record/rigid_places.hpp"

namespace recoil::app {

/// Whether the options ask for a shaded view in place of a plane.
bool asks_for_view(const PlotOptions& options);

/// The direction of --view, "-x" or "-50deg,25deg", with the axis of --up. @throws InputError.
View read_view(const std::string& text, const std::string& up);

/// The plane of --cut with its normal towards the viewer. @throws InputError, also where it is seen from its
/// edge.
SpacePlane read_cut(const std::string& text, const View& view);

/// Which faces of a domain are planes of symmetry: [axis], of the low and of the high face.
std::array<std::array<bool, 3>, 2> symmetric_faces(const config::Domain& domain);

/// Draws shaded views of the bodies of a 3-D run, coloured by a field, as the options of `recoil plot` say.
class SpacePlotter {
 public:
  /// @throws InputError for another geometry, and for options that do not suit it.
  SpacePlotter(const PlotOptions& options, const config::Case& c);

  /// From now on all pictures show the same part of space in the same colours.
  void hold_frame(const std::vector<ChosenDump>& dumps);

  /// @throws InputError for a dump without the field, or a cut that leaves nothing.
  Canvas draw(const ChosenDump& dump) const;

 private:
  SpacePicture empty_picture(const ChosenDump& dump) const;
  /// What a dump holds: the deformable bodies with the field, and where the rigid ones are.
  struct Frame {
    FieldScene field;
    std::vector<RigidPlace> rigid;
    double time;  // s
  };

  Frame frame_of(const ChosenDump& dump) const;
  /// Calls f(scene) with the rigid bodies added to the field, and with --mirror.
  template <class F>
  auto completed(const Frame& frame, F&& f) const;
  ViewWindow seen_of(const Frame& frame) const;

  PlotOptions options_;
  const config::Case& case_;
  View view_;
  std::optional<SpacePlane> cut_;
  std::optional<ViewWindow> window_;  // of all pictures
  std::vector<Category> categories_;
};

}  // namespace recoil::app
