// One program per target: INTARSIA_FUZZ_TARGET names it. With the single argument --seeds FOLDER it writes the seed
// corpus there instead.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const intarsia::fuzz::Target& target = intarsia::fuzz::target(INTARSIA_FUZZ_TARGET);
  try {
    target.run({reinterpret_cast<const char*>(data), size});
  } catch (const std::exception& e) {
    std::fprintf(stderr, "broken promise: %s\n", e.what());
    std::abort();
  }
  return 0;
}

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc == 3 && std::string_view((*argv)[1]) == "--seeds") {
    const std::filesystem::path folder = (*argv)[2];
    std::filesystem::create_directories(folder);
    int n = 0;
    for (const std::string& seed : intarsia::fuzz::target(INTARSIA_FUZZ_TARGET).seeds())
      std::ofstream(folder / ("seed-" + std::to_string(n++)), std::ios::binary) << seed;
    std::exit(0);
  }
  return 0;
}
