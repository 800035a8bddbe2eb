#pragma once

#include <string>
#include <vector>

#include "config/declare/entry.hpp"

namespace recoil::config {

/// A part of the domain in which the cells are always the finest, where the mesh has several levels.
struct Region {
  std::string name;
  Vector lo{}, hi{};  // m

  static constexpr const char* doc =
      "A part of the domain in which the cells are always the finest (of a mesh with levels).";
  static Entries<Region> keys();
};

struct MeshChoice {
  double finest = 0;  // m, cell size
  double offset = 0;  // the mesh is shifted by this fraction of a cell
  int block = 0;      // cells of a block along each axis; 0: chosen by the mesh
  static constexpr int least_block = 9;
  int levels = 1;     // cells of dx, 2 dx, 4 dx ...
  double bend = 0.1;  // of the velocity over three cells, in parts of the yield velocity
  int every = 4;      // steps

  static constexpr const char* doc = "The cells.";
  static Entries<MeshChoice> keys() {
    return {
        {.name = "finest",
         .member = &MeshChoice::finest,
         .unit = "m",
         .positive = true,
         .required = true,
         .doc = "edge of the smallest cells",
         .example = R"("0.05 mm")"},
        {.name = "offset",
         .member = &MeshChoice::offset,
         .least = 0,
         .most = 1,
         .doc = "shifts the mesh by this fraction of a cell, to see how results depend on it",
         .example = "0.37"},
        {.name = "block",
         .member = &MeshChoice::block,
         .least = 0,
         .most = 256,
         .doc = "cells of a block along each axis, 9 or more; 0: chosen by the mesh",
         .example = "16"},
        {.name = "levels",
         .member = &MeshChoice::levels,
         .least = 1,
         .most = 10,
         .doc = "sizes of cells: finest, twice that, four times that ...; the finest stand near surfaces, "
                "where waves pass, and in every [refine.NAME]",
         .example = "4"},
        {.name = "bend",
         .member = &MeshChoice::bend,
         .positive = true,
         .doc = "levels above 1 only: cells are the finest where the second difference of the velocity over "
                "three cells in a row is larger, in parts of the velocity at which an elastic wave "
                "reaches the yield stress, Y / (rho c_L); of the density alike",
         .example = "0.1",
         .when = [](const MeshChoice& m) { return m.levels > 1; }},
        {.name = "every",
         .member = &MeshChoice::every,
         .least = 1,
         .most = 1000,
         .doc = "levels above 1 only: steps after which the levels are fitted to the state again",
         .example = "4",
         .when = [](const MeshChoice& m) { return m.levels > 1; }}};
  }
  /// At least four cells along each axis of the domain.
  void check(const TableReading& reading) const;
};

/// Reads [refine.NAME].
void read_regions(const Node& table, std::vector<Region>& regions, CaseReading& in);

}  // namespace recoil::config
