// Scenes of others give the same pictures with nothing left out and a separate call for every
// model.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "render/renderer.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

using namespace farol;
namespace fs = std::filesystem;

TEST_CASE("external scenes give the same pictures with nothing left out") {
    const fs::path data = fs::path(farol::test::kSourceDir) / ".." / "shared" / "data";
    if (!fs::is_directory(data)) test::skip("no folder ../shared/data");
    render::Renderer renderer;
    int pictures = 0;
    for (const auto& entry : fs::recursive_directory_iterator(data)) {
        const fs::path& file = entry.path();
        if (file.extension() != ".xml" || file.filename().string().starts_with("invalid")) continue;
        std::ifstream in(file, std::ios::binary);
        render::Job job;
        job.name = file.filename().string();
        job.xml = {std::istreambuf_iterator<char>(in), {}};
        job.assets = std::make_shared<scene::FolderAssets>(file.parent_path().string());
        job.identity = file.string();
        job.options.width = 160;
        job.options.height = 120;
        for (const double fov : {60.0, 15.0}) {
            job.options.fovDeg = fov;
            job.drawUnseen = false;
            CAPTURE(file.string(), fov);
            image::Image image, whole;
            try {
                renderer.draw(job, image);
            } catch (const Error& error) {
                // Some lack files; that is another test's matter.
                std::cout << "left out: " << file.filename() << ": " << error.code() << '\n';
                break;
            }
            job.drawUnseen = true;
            renderer.draw(job, whole);
            CHECK(image.pixels == whole.pixels);
            ++pictures;
        }
    }
    CHECK(pictures >= 30);
}
