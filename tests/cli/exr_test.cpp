#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/paths.h"

TEST_CASE("without the module the error names it, and other formats are drawn") {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(farol::test::kTestOutput) / "no_module";
    fs::remove_all(folder);
    fs::create_directories(folder / "bin");
    fs::copy_file(farol::test::kProgram, folder / "bin" / "farol");
    const std::string seeds = std::string(farol::test::kSourceDir) + "/tests/fuzz/seeds/image/";
    const auto draw = [&](const fs::path& program, const std::string& name) {
        fs::copy_file(seeds + name, folder / name, fs::copy_options::overwrite_existing);
        std::ofstream(folder / "scene.xml")
            << "<world><group><models><model file=\"plane_2_1.3d\"><texture file=\"" << name
            << "\"/></model></models></group></world>";
        const std::string command = program.string() + " render " +
                                    (folder / "scene.xml").string() +
                                    " --width 16 --height 16 -o " + (folder / "out.png").string() +
                                    " 2> " + (folder / "errors").string();
        const bool isDrawn = std::system(command.c_str()) == 0;
        std::ifstream errors(folder / "errors");
        return (isDrawn ? "drawn" : "failed: ") +
               std::string(std::istreambuf_iterator<char>(errors), {});
    };
    CHECK_THAT(draw(farol::test::kProgram, "zip.exr"),
               Catch::Equals("drawn"));  // and nothing on standard error
    const std::string failure = draw(folder / "bin" / "farol", "zip.exr");
    CHECK_THAT(failure, Catch::StartsWith("failed") && Catch::Contains("libfarol_oiio.so") &&
                            Catch::Contains("image.unreadable"));
    CHECK_THAT(draw(folder / "bin" / "farol", "flat.hdr"), Catch::StartsWith("drawn"));
}
