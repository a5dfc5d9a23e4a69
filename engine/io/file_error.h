// Errors about the content of a file: "FILE: what is wrong; cure".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/error.h"

namespace intarsia {

// Throws bad_file. `element` is an id in the file's own numbering, named in `what` too.
[[noreturn]] void throw_bad_file(const std::filesystem::path& path, const std::string& what, const std::string& cure,
                                 std::uint64_t element = kNone);

// Throws write_failed, with the system's reason for `errno_value` (0: no reason known).
[[noreturn]] void throw_write_failed(const std::filesystem::path& path, const std::string& what, int errno_value);

// A piece of the user's file as it may be shown in a message: short, one line, no control characters.
std::string printable(std::string_view text);

inline constexpr const char* kCureExportAgain = "export the mesh again from the program that made it";

}  // namespace intarsia
