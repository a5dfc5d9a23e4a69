// The page's own sources, put into the program by the build.
#pragma once

namespace intarsia::tools {

extern const char* const kPageTemplate;
extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace intarsia::tools
