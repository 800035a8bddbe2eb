#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "field/window.hpp"
#include "material/damage/damage.hpp"
#include "state/body.hpp"

namespace recoil {

/// What a cell of a window holds of a body; nothing beyond the domain and where the body is not.
template <int Dim>
Contents<Dim> contents_at(const Body<Dim>& body, const Window<Dim>& window, const Index<Dim>& i) {
  const auto from = window.source_inside(i);
  if (from.slot < 0 || !body.present(from.slot)) return {};
  const auto& b = body.at(from.slot);
  const std::size_t n = b.volume.size();
  Contents<Dim> q;
  for (std::size_t c = 0; c < q.size(); ++c) q[c] = b.contents[c * n + static_cast<std::size_t>(from.cell)];
  return q;
}

/// What the cells of a window hold of one body, by their places in it.
template <int Dim>
class WindowContents {
 public:
  WindowContents(const Body<Dim>& body, const Window<Dim>& window) : body_(body), window_(window) {}

  Contents<Dim> of(int k) const { return contents_at(body_, window_, window_.box().index(k)); }
  bool nothing(int k) const {
    const Contents<Dim> q = of(k);
    return std::all_of(q.begin(), q.end(), [](double c) { return c == 0; });
  }

  /// Whether a fragment has a volume or a mass below zero and lies beside failed matter, which may be mostly
  /// void.
  bool is_beside_voids(int k, double volume) const {
    if (!can_fail(body_.material.damage) || (volume >= 0 && of(k)[0] >= 0)) return false;
    const Index<Dim> i = window_.box().index(k);
    Box<Dim> box{i, i};
    for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
    bool any = false;
    for_each(box, [&](const Index<Dim>& j) {
      const Contents<Dim> q = of(window_.at(j));
      any = any || (q[0] > 0 && q[Components<Dim>::damage] >= failed_damage * q[0]);
    });
    return any;
  }

  /// Whether the mass of the first of these cells, with the part `share` of the others', is not below zero.
  bool balances_mass(std::span<const int> cells, double share) const {
    double sum = of(cells[0])[0];
    for (std::size_t m = 1; m < cells.size() && sum < 0; ++m) sum += share * of(cells[m])[0];
    return sum >= 0;
  }

 private:
  const Body<Dim>& body_;
  const Window<Dim>& window_;
};

}  // namespace recoil
