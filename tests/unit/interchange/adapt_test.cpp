// Scenes in the words of another dialect: without a warning the image is the same to the byte.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "interchange/write.h"
#include "render/renderer.h"
#include "tests/support/paths.h"

using namespace farol;
using scene::Form;
namespace fs = std::filesystem;

namespace {

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

render::Job jobOf(std::string xml, std::shared_ptr<const scene::Assets> assets) {
    render::Job job;
    job.xml = std::move(xml);
    job.assets = std::move(assets);
    job.options.width = job.options.height = 96;
    job.options.timeS = 0.6;
    return job;
}

std::string lossesOf(const interchange::WrittenScene& written) {
    std::string all;
    for (const Diagnostic& one : written.diagnostics)
        if (one.code.starts_with("convert.")) all += one.message + "\n";
    return all;
}

/// Writes the scene in a form. Returns its losses; without one, both images are equal.
std::string convert(render::Renderer& renderer, const render::Job& job, Form form) {
    const interchange::WrittenScene written = interchange::writeXml(job, form);
    const std::string losses = lossesOf(written);
    INFO(scene::kFormWords[form] << "\n" << written.bytes);
    render::Job again = job;
    again.xml = written.bytes;
    image::Image before, after;
    renderer.draw(job, before);
    REQUIRE_NOTHROW(renderer.draw(again, after));
    if (losses.empty()) CHECK(before == after);
    return losses;
}

std::string losses(const std::string& xml, Form form) {
    static render::Renderer renderer;
    return convert(renderer, jobOf(xml, std::make_shared<scene::BundleAssets>()), form);
}

constexpr Form kForms[] = {Form::canonical, Form::course, Form::engine2017, Form::engine2020};

}  // namespace

TEST_CASE("example scenes in each form render to the same bytes, or have a list of losses") {
    render::Renderer renderer;
    int scenes = 0, exact[4] = {};
    for (const char* folder : {"scenes", "docs/examples"})
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(test::kSourceDir) / folder)) {
            if (entry.path().extension() != ".xml") continue;
            if (entry.path().string().find("/refused/") != std::string::npos) continue;
            const auto assets =
                std::make_shared<scene::FolderAssets>(entry.path().parent_path().string());
            const render::Job job = jobOf(readFile(entry.path()), assets);
            INFO(entry.path());
            ++scenes;
            for (const Form form : kForms)
                exact[static_cast<int>(form)] += convert(renderer, job, form).empty();
        }
    CHECK(scenes > 80);
    CHECK(exact[0] == scenes);
    for (const int count : exact) CHECK(count > 5);
}

TEST_CASE("a dialect's own features are written in its words") {
    const std::string course =
        R"(<world><lights><light type="point" posX="2" posY="3" posZ="4"/></lights>
      <group name="g"><transform><translate x="0.5"/><rotate angle="30" y="1"/></transform>
        <models><model file="sphere_1_16_8.3d"><color><diffuse R="200" G="20" B="30"/>
          <ambient R="40" G="40" B="40"/><specular R="255" G="255" B="255"/><shininess value="40"/></color>
        </model><model file="cone_1_2_8_3.3d"/></models></group></world>)";
    for (const Form form : kForms) CHECK(losses(course, form) == "");
    const std::string old = R"(<scene><group><translate x="1"/><lights>
      <light type="POINT" posX="1" posY="2" posZ="3" diffR="0.5" ambtG="0.2"/></lights>
      <models><model file="box_1_2.3d" diffR="0.9" rand="5" xzMinR="1" xzMaxR="2"/></models></group></scene>)";
    CHECK(losses(old, Form::engine2017) == "");
    CHECK(losses(old, Form::course).find("lights only this group") != std::string::npos);
    const std::string colors =
        R"(<scene><colors><color name="c" r="0.9" g="0.1" b="0.3"/></colors><lights>
      <light type="DIRECTIONAL" dirX="1" dirY="1" dirZ="1" diffuse="c"/></lights>
      <group><models><model command="sphere 1" diffuse="rgb" ambient="c"/></models></group></scene>)";
    CHECK(losses(colors, Form::engine2020) == "");
    CHECK(losses(colors, Form::engine2017).find("turn with the time") != std::string::npos);
    CHECK(losses(colors, Form::course).find("colours of lights") != std::string::npos);
}

TEST_CASE("repeated transforms become nested groups") {
    const std::string xml =
        R"(<world><lights><light type="directional" dirX="1" dirY="2" dirZ="3"/></lights>
      <group><transform><translate x="0.5"/><rotate angle="30" y="1"/><translate y="0.3"/>
        <rotate angle="20" x="1"/><scale y="2"/><scale x="0.5"/></transform>
        <models><model file="box_1_2.3d"/></models></group></world>)";
    for (const Form form : {Form::course, Form::engine2017, Form::engine2020})
        CHECK(losses(xml, form) == "");
}

TEST_CASE("too many copies for a document are refused") {
    render::Job job = jobOf(R"(<world><group><scatter count="90000" xzMax="5"/><models>
      <model file="box_1.3d"/></models></group></world>)",
                            std::make_shared<scene::BundleAssets>());
    CHECK_NOTHROW(interchange::writeXml(job, Form::canonical));
    try {
        interchange::writeXml(job, Form::course);
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.code() == "limit.instances");
    }
}
