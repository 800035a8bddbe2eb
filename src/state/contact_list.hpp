#pragma once

#include <vector>

#include "core/vec.hpp"

namespace recoil {

/// A pair of bodies that touch in a cell, and what they do to each other there in the latest stage.
template <int Dim>
struct Contact {
  int cell = 0;               // in the layout of its block
  int first = 0, second = 0;  // bodies; the first is deformable, and the lower-numbered one if both are
  bool one_sided = false;     // only the first bears it (ghost-fluid schemes, in which each body has its own
                              // contact and the first may be the higher-numbered one); else both do
  Vec<Dim> direction;         // out of the first
  Vec<Dim> point;             // m, middle of the first one's surface
  double area = 0;            // shared [m^(Dim-1)], per radian and r-weighted in an axisymmetric domain
  double traction = 0;        // Pa, along the direction, below 0 in compression
  Vec<Dim> shear;             // Pa, on the first, across the direction
  double work_velocity = 0;   // m/s, along the direction, with which the traction works on both
  Vec<Dim> shear_velocity;    // m/s, across the direction, with which the shear works on both
  Vec<Dim> slip;              // m/s, of the first one's surface over that of the second
  double gap = 0;             // m, between the surfaces; below 0: overlap
};

/// The contacts of one block in the order in which they were found.
template <int Dim>
using ContactList = std::vector<Contact<Dim>>;

}  // namespace recoil
