#pragma once

#include <array>
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
  bool is_error = false;       // the quantity is an error by itself: only an upper limit is expected
  std::vector<double> sizes;   // m, falling
  std::vector<double> mean;    // over the offsets
  std::vector<double> spread;  // half of largest minus smallest over the offsets
  std::vector<double> error;   // mean of |value - reference| over the offsets; where the quantity is an error
                               // by itself (an upper limit is expected) its mean size
  std::vector<double> from_finest;  // |mean - finest mean| / |finest mean|: the error measure of the
                                    // contact-separation paper, eq. (27)
  std::vector<double> order;        // of `error`, from the mesh before; NaN for the first
  double own_order = 0;             // by which the three finest meshes approach each other; NaN: they do not
  double extrapolated = 0;          // Richardson's value at cells of size zero by that order, SI; NaN: none
};

/// The order p for which q = q0 + a h^p goes through three values at falling sizes h; NaN where there is none
/// between 0.1 and 10: values that do not approach each other from one side, or equal ones.
double observed_order(const std::array<double, 3>& sizes, const std::array<double, 3>& values);
/// That q0. @param order of observed_order(); NaN gives NaN.
double extrapolated_value(const std::array<double, 3>& sizes, const std::array<double, 3>& values,
                          double order);

/// Balances have no order: they are round-off on any mesh. Nor have errors below 1e-10 of the reference or
/// limit.
std::vector<StudyRow> rows_of(const StudyTable& table);

/// The table for people.
std::string study_markdown(const StudyTable& table);
/// One line for each run and quantity.
std::string study_csv(const StudyTable& table);

}  // namespace recoil::app
