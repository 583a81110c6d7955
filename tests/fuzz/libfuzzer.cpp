// The functions that the driver gives to targets, for builds with libFuzzer, which watches the code
// itself.
#include "tests/fuzz/target.h"

namespace farol::fuzz {

void reached(std::string_view) {}

}  // namespace farol::fuzz
