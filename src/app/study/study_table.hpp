#pragma once

#include <string>
#include <vector>

namespace recoil::app {

/// One quantity that one run of a study found.
struct StudyValue {
  double value = 0;      // SI; NaN: none
  double reference = 0;  // SI; NaN where only a limit is given
  double limit = 0;      // SI; of one-sided expectations, else NaN
  std::string unit;      // to print with
};

/// One run: a size of cells, a shift of the mesh, and its quantities in the order of StudyTable::quantities.
struct StudyRun {
  double size = 0;    // m
  double offset = 0;  // cells
  std::vector<StudyValue> values;
};

struct StudyTable {
  std::string title;
  std::vector<std::string> quantities;
  std::vector<StudyRun> runs;  // in any order
};

/// A quantity on all meshes, coarse to fine.
struct StudyRow {
  std::string quantity, unit;
  double reference = 0;        // SI; NaN: none
  std::vector<double> sizes;   // m, falling
  std::vector<double> mean;    // over the offsets
  std::vector<double> spread;  // half of largest minus smallest over the offsets
  std::vector<double> error;   // mean of |value - reference| over the offsets; where the quantity is an error
                               // by itself (an upper limit is expected) its mean size
  std::vector<double> from_finest;  // |mean - finest mean| / |finest mean|: the error measure of the
                                    // contact-separation paper, eq. (27)
  std::vector<double> order;        // of `error`, from the mesh before; NaN for the first
};

/// Balances have no order: they are round-off on any mesh. Nor have errors below 1e-10 of the reference or
/// limit.
std::vector<StudyRow> rows_of(const StudyTable& table);

/// The table for people.
std::string study_markdown(const StudyTable& table);
/// One line for each run and quantity.
std::string study_csv(const StudyTable& table);

}  // namespace recoil::app
