#pragma once

/// All kinds of pictures: charts of curves, fields in the plane, outlines of bodies.
#include "picture/canvas.hpp"
#include "picture/field_picture.hpp"
#include "picture/line_chart.hpp"
#include "picture/outline.hpp"
