#pragma once

#include <vector>

#include "config/case.hpp"
#include "material/material.hpp"

namespace recoil::app {

/// Cells of the case's mesh whose centre lies in each body, by sampling: exact in small cases, about 1 % off
/// in large ones.
std::vector<double> cells_of_bodies(const config::Case& c);

/// What a run will take, before it starts.
struct Estimate {
  double cells = 0;           // of the domain
  double material_cells = 0;  // of all bodies, if all were the finest
  double start_cells = 0;     // of a mesh of several levels, at the start, with matter around
  double cut_cells = 0;       // of all bodies
  double step = 0;            // s
  double steps = 0;
  double memory = 0;   // bytes, the most, while fields are written; of a mesh of several levels at the start
  double seconds = 0;  // of wall time with one thread; of several levels, if it stayed as at the start
};

/// @param materials one for each body. @param fastest largest sum over the axes of |u| + c_L to be expected
/// [m/s]
Estimate estimate(const config::Case& c, const std::vector<Material>& materials, double fastest);

/// Memory of one cell full of matter [bytes], with its share of the cells of blocks that are partly empty.
double bytes_of_cell(const config::Case& c);

/// Signal speed of a case at its start [m/s]: the largest of |u| + c_L over its bodies, per axis.
double fastest_at_start(const config::Case& c, const std::vector<Material>& materials);

}  // namespace recoil::app
