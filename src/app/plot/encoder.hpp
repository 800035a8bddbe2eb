#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace recoil::app {

/// The programs that make one file of many pictures. Which of them by the suffix of the file:
/// .webp img2webp, .apng apngasm, .mp4 ffmpeg, which does for the other two as well where they are missing.
class Encoder {
 public:
  /// @throws InputError for another suffix, EnvironmentError where there is no program for it.
  explicit Encoder(const std::filesystem::path& file);

  /// Name of picture n in the folder; n counts from 0.
  static std::string picture_name(std::size_t n);
  /// Makes the file of so many pictures in a folder. @param rate pictures a second.
  /// @throws EnvironmentError where the program fails.
  void encode(const std::filesystem::path& folder, std::size_t pictures, double rate) const;

 private:
  std::vector<std::string> words(const std::filesystem::path& folder, std::size_t pictures, double rate,
                                 const std::string& output) const;
  std::filesystem::path file_;
  std::string suffix_, program_;
};

}  // namespace recoil::app
