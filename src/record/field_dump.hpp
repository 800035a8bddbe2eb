#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "format/unstructured_grid.hpp"
#include "format/vtkhdf.hpp"
#include "gauge/fragments/fragments.hpp"
#include "parallel/world.hpp"
#include "state/body.hpp"

namespace recoil {

/// One thing that fields can hold.
struct FieldVariable {
  const char* name;   ///< in a case: "plastic-strain"
  const char* array;  ///< in the file, with its unit: "pressure_GPa"
  const char* label;  ///< for people: "pressure [GPa]"
  int components;  ///< 1, 3 (velocity) or 6 (stress: xx, yy, zz, xy, yz, xz; axisymmetric: rr, zz, tt, rz, 0,
                   ///< 0)
  bool signed_values;  ///< both signs mean something: a diverging colour map suits
};

/// All of them, in the order in which they are written.
const std::vector<FieldVariable>& field_variables();

/// Pictures of the whole domain: fields/NAME_000000.hdf, ... and fields/NAME.hdf.series. A dump holds every
/// cell with matter or within 2 dx of a surface. Where bodies share a cell it shows the one that has most of
/// it, its number in `body` (-1: none). Cells with less than 0.3 of a cell of matter have NaN for the state.
/// `volume_fraction` is of all bodies; `contact` has the bit of every body that the shown one touched in the
/// last step. On surfaces, else NaN: `contact_state` (0 free, 1 touching, 2 slipping, 3 opened: apart, but
/// facing within 8 cells a body touched before), `gap_mm` to the nearest body (NaN: none within 8 cells;
/// below 0: overlap) and the normal `contact_traction_GPa`. `level_set_NAME_m` is the signed distance to each
/// body, cut off at 8 dx.
template <int Dim>
class FieldDump {
 public:
  /// @param variables names as in field_variables(); empty: all. @throws InputError for an unknown one.
  FieldDump(std::filesystem::path folder, std::string name, const std::vector<std::string>& variables);
  /// Collective; rank 0 writes. @throws EnvironmentError.
  /// @param fragments of this state: what the variable `fragment` shows.
  void write(const State<Dim>& state, const parallel::World& world,
             const Fragments<Dim>* fragments = nullptr);
  /// Time of the last dump [s], or below 0.
  double last() const { return series_.empty() ? -1 : series_.back().time_s; }

  /// For checkpoints: what has been written. After unpack() files of later times are removed.
  void pack(parallel::Bytes& bytes) const;
  void unpack(parallel::Unpacker& from, bool removes);

 private:
  std::filesystem::path folder_;
  std::string name_;
  std::vector<FieldVariable> variables_;
  std::vector<SeriesEntry> series_;
};

/// Memory that a dump takes on rank 0 while it is put together, for each cell in it [bytes]: what the
/// processes have sent, the grid with the corners of each cell, its arrays, and the table by which corners
/// are joined.
/// @param variables names as for FieldDump.
template <int Dim>
double bytes_of_dumped_cell(const std::vector<std::string>& variables, std::size_t bodies);

/// The grid of one dump, complete on rank 0, empty elsewhere. Collective.
template <int Dim>
UnstructuredGrid gather_fields(const State<Dim>& state, const parallel::World& world,
                               const std::vector<FieldVariable>& variables,
                               const Fragments<Dim>* fragments = nullptr);

/// The same of the blocks of this process alone, for what is said of its failure; it knows of no surface that
/// it has opened. Not collective.
template <int Dim>
UnstructuredGrid own_fields(const State<Dim>& state, const std::vector<FieldVariable>& variables);

}  // namespace recoil
