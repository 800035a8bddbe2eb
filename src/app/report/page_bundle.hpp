#pragma once

#include <string_view>

namespace recoil::app {

/// The page into which reports are put, built from report/ by CMake (cmake/recoil_report.cmake); empty where
/// the program was built without node.
std::string_view page_bundle();

}  // namespace recoil::app
