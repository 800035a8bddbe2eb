#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/marks.hpp"
#include "core/scratch.hpp"
#include "field/window.hpp"
#include "state/body.hpp"

namespace recoil {

/// The cells that the window around a block shows, as donors. A cell is looked up when the first fit reads
/// its row.
template <int Dim>
class Candidates {
 public:
  Candidates(const State<Dim>& state, const Body<Dim>& body, const Window<Dim>& w, Scratch& scratch)
      : state_(state), body_(body), window_(w) {
    const auto n = static_cast<std::size_t>(w.size());
    donates_ = scratch.take<std::uint8_t>(n + beyond);
    w.gather([&](int s) { return body.present(s) ? body.at(s).role.data() : nullptr; }, std::uint8_t{0},
             Beyond::extend, donates_);
    std::fill(donates_ + n, donates_ + n + beyond, std::uint8_t{0});
    for (std::size_t k = 0; k < n; ++k) donates_[k] &= donates;
    unknown_ = scratch.take<std::uint8_t>(n + beyond);
    std::copy(donates_, donates_ + n + beyond, unknown_);
    fill_ = scratch.take_filled<double>(n + beyond, 0);
    place_ = scratch.take<int>(n);
    for (double*& component : centroid_) component = scratch.take<double>(n + beyond);
  }

  /// Looks up the cells of a row from index i on, which is place k of the window. @returns whether any of it
  /// may donate.
  bool look_up(Index<Dim> i, int k, int count) {
    if (!any_set(donates_ + k, count)) return false;
    if (any_set(unknown_ + k, count))
      for (int c = k; c < k + count; ++c, ++i[0])
        if (unknown_[c] != 0) look_up(i, c);
    return true;
  }

  /// V/full of the cells from place k on, at most 1; 0: does not donate.
  const double* fills(int k) const { return fill_ + k; }
  /// Centroids of the matter from the centres of the cells, as the window shows them, from place k on [dx].
  /// Anything where a cell does not donate.
  std::array<const double*, Dim> centroids(int k) const {
    std::array<const double*, Dim> from;
    for (std::size_t d = 0; d < Dim; ++d) from[d] = centroid_[d] + k;
    return from;
  }
  /// The place of the cell at index i in Donors::cells, where it is put if it is not there.
  int place(const Index<Dim>& i, int k, FieldArray<DonorCell>& cells) {
    if (place_[k] < 0) {
      place_[k] = static_cast<int>(cells.size());
      const auto from = window_.source(i);
      cells.push_back({from.slot, from.cell, from.flips});
    }
    return place_[k];
  }

 private:
  void look_up(const Index<Dim>& i, int k) {
    const auto from = window_.source(i);
    const BodyBlock<Dim>& home = body_.at(from.slot);
    const Grid<Dim>& grid = state_.grid();
    const Index<Dim> cell = state_.mesh.block(from.slot).cells.lo + grid.layout().index(from.cell);
    unknown_[k] = 0;
    place_[k] = -1;
    for (double* component : centroid_) component[k] = 0;
    fill_[k] = std::min(home.volume[from.cell] / grid.full_volume(cell), 1.0);
    if (const int cut = home.geometry.index[from.cell]; cut >= 0) {
      const Vec<Dim>& centroid = home.geometry.cuts[cut].centroid;
      for (int d = 0; d < Dim; ++d)
        centroid_[d][k] = (from.flips >> d & 1U) != 0 ? -centroid[d] : centroid[d];
    }
  }

  const State<Dim>& state_;
  const Body<Dim>& body_;
  const Window<Dim>& window_;
  static constexpr std::size_t beyond = marks_beyond;  // places behind the last cell, which rows may read
  std::uint8_t *donates_, *unknown_;                   // the latter: not looked up yet
  double* fill_;
  // Set where a cell has been looked up:
  int* place_;  // -1: not in Donors::cells yet
  std::array<double*, Dim> centroid_;
};

}  // namespace recoil
