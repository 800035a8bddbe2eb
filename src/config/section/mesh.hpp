#pragma once

#include "config/declare/entry.hpp"

namespace recoil::config {

struct MeshChoice {
  double finest = 0;  // m, cell size
  double offset = 0;  // the mesh is shifted by this fraction of a cell
  int block = 0;      // cells of a block along each axis; 0: chosen by the mesh

  static constexpr const char* doc = "The cells.";
  static Entries<MeshChoice> keys() {
    return {{.name = "finest",
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
             .doc = "cells of a block along each axis; 0: chosen by the mesh",
             .example = "16"}};
  }
  /// At least four cells along each axis of the domain.
  void check(const TableReading& reading) const;
};

}  // namespace recoil::config
