#pragma once

#include <string>
#include <vector>

namespace recoil::app {

/// Names of the cases to start from, sorted: the files of the folder templates/.
std::vector<std::string> template_names();

}  // namespace recoil::app
