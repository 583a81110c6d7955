#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace farol {

/// 16 hexadecimal digits that change when this program or any library it has loaded (Mesa, LLVM,
/// libtiff ...) is another build: a digest of the GNU build ids of all of them. Images
/// rendered under two values may differ.
std::string buildId();

/// The same with those loaded now whose file names begin with one of `libraries`, in the order of
/// `libraries`.
std::string buildIdWith(std::initializer_list<std::string_view> libraries);

}  // namespace farol
