#include "dynamics/classic_stages.hpp"

#include <algorithm>
#include <cstddef>

namespace recoil {

template <int Dim>
void start_stage(BodyBlock<Dim>& b) {
  std::copy(b.contents_old.begin(), b.contents_old.end(), b.contents.begin());
}

template <int Dim>
void collect_stage(BodyBlock<Dim>& b, const ClassicStage& stage) {
  if (b.contents_sum.size() != b.contents.size()) b.contents_sum.assign(b.contents.size(), 0);
  const double factor = stage.weight / stage.length;
  double* sum = b.contents_sum.data();
  const double *now = b.contents.data(), *old = b.contents_old.data();
  const std::size_t n = b.contents.size();
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) sum[k] += factor * (now[k] - old[k]);
}

template <int Dim>
void finish_stages(BodyBlock<Dim>& b) {
  for (std::size_t k = 0; k < b.contents.size(); ++k) b.contents[k] = b.contents_old[k] + b.contents_sum[k];
  std::fill(b.contents_sum.begin(), b.contents_sum.end(), 0.0);
}

#define RECOIL_INSTANTIATE(Dim)                                           \
  template void start_stage<Dim>(BodyBlock<Dim>&);                        \
  template void collect_stage<Dim>(BodyBlock<Dim>&, const ClassicStage&); \
  template void finish_stages<Dim>(BodyBlock<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
