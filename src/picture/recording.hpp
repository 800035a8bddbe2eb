#pragma once

#include <cairo.h>

#include "picture/canvas.hpp"

namespace recoil {

/// Throws EnvironmentError with Cairo's words where something failed.
void require_drawn(cairo_status_t status);

/// Cairo's surface with the pen that draws on it; for the files that draw.
struct Canvas::Recording {
  cairo_surface_t* surface = nullptr;
  cairo_t* pen = nullptr;

  /// Takes the surface over.
  explicit Recording(cairo_surface_t* target) : surface(target), pen(cairo_create(target)) {}
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording() {
    cairo_destroy(pen);
    cairo_surface_destroy(surface);
  }
};

}  // namespace recoil
