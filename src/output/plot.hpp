#pragma once

/// All kinds of pictures: charts of curves, fields in the plane, outlines of bodies.
#include "output/field_picture.hpp"
#include "output/line_chart.hpp"
#include "output/outline.hpp"
#include "output/png.hpp"
