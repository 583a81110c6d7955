#pragma once

#include <string>

namespace farol::render {

/// 16 hexadecimal digits that change when this program or any library it has loaded (Mesa, LLVM,
/// OpenImageIO ...) is another build: a digest of the GNU build ids of all of them. What was
/// rendered under one value may differ under another.
std::string buildId();

}  // namespace farol::render
