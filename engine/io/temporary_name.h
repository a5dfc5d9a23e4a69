// Names of things that are being written, so that a later run can tell what a killed one has left behind.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace intarsia {

// What the name stands for: a result in the making, or an earlier one on its way out.
enum class Temporary { new_result, old_result };

// A name for use beside `target`, hidden, of fixed length (hash of the target's name, host, process, running number).
std::string temporary_name(Temporary kind, const std::filesystem::path& target);

// Whether `name` was made for `target` on this host by a process that no longer exists.
bool is_abandoned(std::string_view name, Temporary kind, const std::filesystem::path& target);

// Whether `name` has the form of such a name, whoever made it and wherever.
bool is_temporary_name(std::string_view name);

}  // namespace intarsia
