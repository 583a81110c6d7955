#pragma once

#include <string>

namespace farol {

/// The status of a caller's fault by the family of its code: option.*, http.*, xml.* and bundle.*
/// 400 (unless listed otherwise), limit.body and limit.store 413, everything else 422.
int statusOf(const std::string& code);

}  // namespace farol
