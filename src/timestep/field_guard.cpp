#include "timestep/field_guard.hpp"

#ifndef NDEBUG

#include <fmt/format.h>

#include <cstdlib>
#include <exception>

#include "core/hash.hpp"

namespace recoil {

namespace {

/// f(body, declaration, hash) for every field of the block that a phase may not write.
template <int Dim, class F>
void for_each_kept(const State<Dim>& state, int slot, const FieldAccess& access, F&& f) {
  for (const Body<Dim>& body : state.bodies)
    for_each_field<Dim>([&](const auto& d) {
      if (access.writes.has(d.id)) return;
      std::uint64_t hash = 0;
      for_each_array(body.at(slot).*d.member, [&](const auto& array) {
        const auto& values = array.raw();
        hash ^= hash_of(values.data(), values.size() * sizeof(values[0])) + values.size();
      });
      f(body, d, hash);
    });
}

}  // namespace

template <int Dim>
FieldGuard<Dim>::FieldGuard(const State<Dim>& state, int slot, const FieldAccess& access)
    : state_(state), slot_(slot), access_(access) {
  for_each_kept(state, slot, access,
                [&](const Body<Dim>&, const auto&, std::uint64_t hash) { before_.push_back(hash); });
  current_access = &access_;
}

template <int Dim>
FieldGuard<Dim>::~FieldGuard() {
  current_access = nullptr;
  if (std::uncaught_exceptions() > 0) return;
  std::size_t k = 0;
  for_each_kept(state_, slot_, access_, [&](const Body<Dim>& body, const auto& d, std::uint64_t hash) {
    if (before_[k++] == hash) return;
    fmt::print(stderr, "internal error: the phase '{}' changed the field '{}' of '{}' without declaring it\n",
               access_.phase, d.name, body.name);
    std::abort();
  });
}

template class FieldGuard<1>;
template class FieldGuard<2>;
template class FieldGuard<3>;

}  // namespace recoil

#endif
