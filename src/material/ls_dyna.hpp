#pragma once

#include <string>
#include <vector>

#include "material/material.hpp"

namespace recoil {

/// A coherent system of units of a keyword file: what 1 of each is in SI.
struct CardUnits {
  const char* name;  // "g-cm-us"
  double mass, length, time;

  double density() const { return mass / (length * length * length); }
  double velocity() const { return length / time; }
  double pressure() const { return mass / (length * time * time); }
};

/// The systems that files are usually written in.
const std::vector<CardUnits>& card_units();

struct ImportedMaterial {
  Material material;
  std::vector<std::string> left_out;  // what the cards say and the material does not
};

/// A material from the cards of an LS-DYNA keyword file: *MAT_JOHNSON_COOK (*MAT_015) and *EOS_GRUNEISEN
/// (Livermore Software, LS-DYNA Keyword User's Manual, volume II), the first of each; numbers in fields of
/// ten characters or with commas; the title is that of *MAT_JOHNSON_COOK_TITLE. @param file its name, for
/// messages. @throws InputError that names what is missing or no number, and where.
ImportedMaterial import_cards(const std::string& text, const CardUnits& units, const std::string& file);

}  // namespace recoil
