#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#ifndef NDEBUG
#include <string>

#include "core/error.hpp"
#endif
#include "field/field.hpp"

namespace recoil {

#ifndef NDEBUG
/// In debug builds: what the phase that this thread is in has declared; null outside of phases.
inline thread_local const FieldAccess* current_access = nullptr;
#endif

/// The values of one field in one block, component after component. A std::vector that knows which field it
/// holds: in debug builds a phase that touches a field without having declared it stops with an
/// InternalError.
template <class T>
class FieldArray {
 public:
  using value_type = T;

#ifndef NDEBUG
  explicit FieldArray(Field field) : field_(field) {}
#else
  explicit FieldArray(Field) {}
#endif
  FieldArray(const FieldArray&) = default;
  FieldArray(FieldArray&&) noexcept = default;
  ~FieldArray() = default;
  /// Takes the values; each array goes on being that of its own field.
  FieldArray& operator=(const FieldArray& other) {
    check();
    other.check();
    values_ = other.values_;
    return *this;
  }
  FieldArray& operator=(FieldArray&& other) noexcept {
    values_ = std::move(other.values_);
    return *this;
  }
  /// Exchanges the values with those of another field.
  void swap(FieldArray& other) {
    check();
    other.check();
    values_.swap(other.values_);
  }

  T* data() { return checked().data(); }
  const T* data() const { return checked().data(); }
  T& operator[](std::size_t k) { return checked()[k]; }
  const T& operator[](std::size_t k) const { return checked()[k]; }
  auto begin() { return checked().begin(); }
  auto end() { return checked().end(); }
  auto begin() const { return checked().begin(); }
  auto end() const { return checked().end(); }
  T& back() { return checked().back(); }
  const T& back() const { return checked().back(); }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }

  void assign(std::size_t n, const T& value) { checked().assign(n, value); }
  void resize(std::size_t n) { checked().resize(n); }
  void clear() { checked().clear(); }
  void reserve(std::size_t n) { checked().reserve(n); }
  void push_back(const T& value) { checked().push_back(value); }
  template <class... Args>
  T& emplace_back(Args&&... args) {
    return checked().emplace_back(std::forward<Args>(args)...);
  }
  friend bool operator==(const FieldArray& a, const FieldArray& b) { return a.values_ == b.values_; }

  /// The values whatever phase asks: for allocation, exchange and the checks themselves.
  std::vector<T>& raw() { return values_; }
  const std::vector<T>& raw() const { return values_; }

 private:
#ifndef NDEBUG
  void check() const {
    if (current_access && !current_access->touched().has(field_))
      throw InternalError("internal error: the phase '" + std::string(current_access->phase) +
                          "' touches field " + std::to_string(static_cast<int>(field_)) +
                          " (enum Field) without having declared it");
  }
  Field field_;
#else
  void check() const {}
#endif
  std::vector<T>& checked() {
    check();
    return values_;
  }
  const std::vector<T>& checked() const {
    check();
    return values_;
  }

  std::vector<T> values_;
};

}  // namespace recoil
