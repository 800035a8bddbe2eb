#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "picture/canvas.hpp"
#include "picture/colour_map.hpp"
#include "picture/marks.hpp"
#include "picture/outline.hpp"

namespace recoil {

/// A field in the plane as colours, with the outlines of bodies and a colour bar. Also an x-t diagram:
/// then y is time and `equal_aspect` false.
struct FieldPicture {
  int nx = 0, ny = 0;
  double x0 = 0, y0 = 0;         ///< lower left corner of the cells [m] (or s)
  double dx = 0, dy = 0;         ///< size of a cell [m] (or s)
  std::vector<double> values{};  ///< cell (i, j) at [i + nx * j]; NaN: nothing there
  /// Signed distance, negative inside, same shape; empty: none. With it the edge of the matter is drawn
  /// smooth where it crosses zero, and not along the cells.
  std::vector<double> level_set{};
  std::vector<Outline> outlines{};    ///< drawn dark, physical coordinates
  std::vector<Outline> mesh_lines{};  ///< drawn thin and pale (edges of blocks)
  std::string title{}, note{};        ///< heading on the left; on the right, e.g. the time
  std::string label{};                ///< of the colour bar, with unit: "pressure [GPa]"
  ColourMap map = ColourMap::sequential;
  std::optional<std::pair<double, double>> range{};  ///< of the colours; none: of the values
  bool log = false;  ///< logarithmic colours; values at or below 0 take the lowest one
  std::vector<Category>
      categories{};          ///< the values that there are, each with its colour; no colour bar then
  bool interpolate = false;  ///< linear between cell centres; false shows each cell
  bool mirror = false;       ///< axisymmetric: draw x < 0 as the mirror image of x > 0
  bool equal_aspect = true;
  bool y_labels = true;  ///< false where the vertical axis has no meaning (1-D)
  std::string x_title = "x [mm]", y_title = "y [mm]";
  double x_scale = 1e3, y_scale = 1e3;     ///< from the data's unit to the one in the title
  int max_width = 1200, max_height = 900;  ///< of the whole picture [pixels]
  int detail = 1;  ///< samples of the field per pixel and axis in the file; 2 suits SVG and PDF
  /// At places in the plane, with arrows by velocities [m/s]; the fastest has the longest arrow.
  std::vector<Mark> marks{};
  std::vector<Outline> references{};  ///< drawn orange, on top: what the outlines are compared with
};

/// Draws it. Where values lie beyond the range, that end of the colour bar is pointed. @throws InternalError
/// where values (or level_set) are not nx * ny, or a size is not positive.
Canvas field_picture(const FieldPicture& picture);

}  // namespace recoil
