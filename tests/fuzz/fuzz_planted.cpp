// A target with faults on purpose: it shows that the driver finds, tells apart and saves them.
// PLANT is one of "throw", "crash", "hang", "memory".
#include <csignal>
#include <string_view>

#include "tests/fuzz/target.h"

namespace farol::fuzz {

const Target& target() {
    static const Target made{{"txt"}, {"token"}, 128};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol::fuzz;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // The seed holds the first word only: edits have to bring the second.
    if (!text.starts_with("plant") || text.find("token") == std::string_view::npos) return 0;
    constexpr std::string_view kPlant = PLANT;
    if (kPlant == "throw") throw std::runtime_error("planted");
    if (kPlant == "crash") std::raise(SIGSEGV);
    if (kPlant == "memory") {
        static std::vector<char> hoard;
        hoard.assign(std::size_t{1} << 30U, 'x');
    }
    while (kPlant == "hang") reached("");
    return 0;
}
