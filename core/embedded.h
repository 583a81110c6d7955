#pragma once

#include <string_view>

namespace farol {

/// A file of the project that is linked into the program (cmake/embed.cmake).
struct EmbeddedFile {
    std::string_view name;  ///< base name, or path in the folder that was embedded
    std::string_view bytes;
};

}  // namespace farol
