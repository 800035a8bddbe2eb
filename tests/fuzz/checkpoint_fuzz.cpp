// A checkpoint of any bytes: it is read, or an InputError says that it cannot be used. The same bytes also
// stand for the text in a checkpoint that says of which case it is.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/run/checkpoint_folder.hpp"
#include "core/error.hpp"
#include "format/block_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace recoil;
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("recoil_checkpoint_fuzz_" + std::to_string(getpid()));
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::ofstream(file, std::ios::binary).write(text.data(), static_cast<std::streamsize>(size));
  try {
    const BlockFile blocks(file);
    for (long b = 0; b < blocks.blocks(); ++b) blocks.record(b);
  } catch (const InputError&) {
  }
  try {
    app::checkpoint_text(text);
  } catch (const InputError&) {
  }
  std::filesystem::remove(file);
  return 0;
}
