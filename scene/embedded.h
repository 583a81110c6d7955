#pragma once

#include <string_view>

namespace farol {

/// A file of the project that is linked into the program (cmake/embed.cmake).
struct EmbeddedFile {
    std::string_view name;  ///< base name
    std::string_view bytes;
};

}  // namespace farol
