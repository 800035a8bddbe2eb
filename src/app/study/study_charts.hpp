#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/study_table.hpp"

namespace recoil::app {

/// One mesh of a study: a size of cells and the folder of its run.
struct StudyMesh {
  std::string size;
  std::filesystem::path run;
};

/// Draws what a study found into its folder: error.png, the error of each quantity against the size of the
/// cells, and GAUGE_COLUMN.png for each record that a quantity is read from, all meshes over each other, and
/// the reference curve that an expected distance names.
/// @param case_folder where the reference curves lie.
/// @returns the files. @throws InputError for a record or reference that cannot be read.
std::vector<std::filesystem::path> write_study_charts(const std::filesystem::path& folder,
                                                      const StudyTable& table,
                                                      const std::vector<StudyMesh>& meshes,
                                                      const std::filesystem::path& case_folder);

}  // namespace recoil::app
