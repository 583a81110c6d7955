#pragma once

#include <string>

namespace farol {

/// 16 hexadecimal digits that change when this program or any library it has loaded (Mesa, LLVM,
/// libtiff ...) is another build: a digest of the GNU build ids of all of them. Images
/// rendered under two values may differ.
std::string buildId();

}  // namespace farol
